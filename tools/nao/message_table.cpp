#include "tools/nao/message_table.h"

#include <array>
#include <charconv>
#include <functional>

#include "tools/nao/message_walk.h"

namespace nao {
namespace {

/** Gives every value the name of its column. */
class Flattener : public MessageVisitor {
 public:
  using Take = std::function<void(const std::string& column, const std::string& value)>;
  explicit Flattener(Take take) : take_(std::move(take)) {}

  void begin_struct(const std::string& key) override { enter(key, false); }
  void end_struct() override { levels_.pop_back(); }
  void begin_list(const std::string& key) override { enter(key, true); }
  void end_list() override { levels_.pop_back(); }
  void integer(const std::string& key, int64_t value) override {
    take_(name_of(key), std::to_string(value));
  }
  void number(const std::string& key, double value) override {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    take_(name_of(key), std::string(digits.data(), end));
  }
  void boolean(const std::string& key, bool value) override {
    take_(name_of(key), value ? "1" : "0");
  }
  void text(const std::string& key, const std::string& value) override {
    take_(name_of(key), csv_quoted(value));
  }
  void bytes(const std::string& key, std::span<const uint8_t> value) override {
    take_(name_of(key), std::to_string(value.size()));
  }

 private:
  struct Level {
    std::string name;
    bool is_list;
  };

  std::string name_of(const std::string& key) const {
    if (levels_.empty()) return key;
    const Level& level = levels_.back();
    return level.is_list ? level.name + "[" + key + "]" : level.name + "." + key;
  }
  void enter(const std::string& key, bool is_list) { levels_.push_back({name_of(key), is_list}); }

  Take take_;
  std::vector<Level> levels_;
};

}  // namespace

bool MessageTable::see(std::span<const uint8_t> message) {
  std::vector<std::string> seen;
  Flattener flattener([&](const std::string& column, const std::string& /*value*/) {
    if (!columns_.contains(column)) seen.push_back(column);
  });
  if (!walk_message(*layout_, message, flattener)) return false;
  for (const std::string& column : seen) {
    if (columns_.try_emplace(column, names_.size()).second) names_.push_back(column);
  }
  return true;
}

std::string MessageTable::heading() const {
  std::string line;
  for (const std::string& name : names_) line += (line.empty() ? "" : ",") + csv_quoted(name);
  return line;
}

std::string MessageTable::row(std::span<const uint8_t> message) const {
  std::vector<std::string> cells(names_.size());
  Flattener flattener([&](const std::string& column, const std::string& value) {
    const auto place = columns_.find(column);
    if (place != columns_.end()) cells[place->second] = value;
  });
  if (!walk_message(*layout_, message, flattener)) return "";
  std::string line;
  for (size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : ",") + cells[i];
  return line;
}

std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace nao
