#include "tools/nao-tools/message_table.h"

#include <array>
#include <charconv>
#include <functional>

#include "message_reflection/number_fields.h"

namespace nao {
namespace {

/** Passes each value on with the name of its column. */
class Flattener : public PathVisitor {
 public:
  using Take = std::function<void(const std::string& column, const std::string& value)>;
  explicit Flattener(Take take) : take_(std::move(take)) {}

  void integer(const std::string& key, int64_t value) override {
    take_(path(key), std::to_string(value));
  }
  void number(const std::string& key, double value) override {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    take_(path(key), std::string(digits.data(), end));
  }
  void boolean(const std::string& key, bool value) override { take_(path(key), value ? "1" : "0"); }
  void text(const std::string& key, const std::string& value) override {
    take_(path(key), csv_quoted(value));
  }
  void bytes(const std::string& key, std::span<const uint8_t> value) override {
    take_(path(key), std::to_string(value.size()));
  }

 private:
  Take take_;
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
