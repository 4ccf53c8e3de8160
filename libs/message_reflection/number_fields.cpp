#include "message_reflection/number_fields.h"

#include "message_reflection/message_types.h"

namespace nao {
namespace {

class NumberVisitor : public PathVisitor {
 public:
  explicit NumberVisitor(const std::function<void(const NumberField&)>& visit) : visit_(visit) {}

  void integer(const std::string& key, int64_t value) override {
    visit_({path(key), static_cast<double>(value), ""});
  }
  void enumerator(const std::string& key, int64_t value, const std::string& constant) override {
    visit_({path(key), static_cast<double>(value), constant});
  }
  void number(const std::string& key, double value) override { visit_({path(key), value, ""}); }
  void boolean(const std::string& key, bool value) override {
    visit_({path(key), value ? 1.0 : 0.0, ""});
  }
  void text(const std::string& /*key*/, const std::string& /*value*/) override {}
  void bytes(const std::string& /*key*/, std::span<const uint8_t> /*value*/) override {}

 private:
  const std::function<void(const NumberField&)>& visit_;
};

}  // namespace

std::string PathVisitor::path(const std::string& key) const {
  if (levels_.empty()) return key;
  const Level& level = levels_.back();
  return level.is_list ? level.path + "[" + key + "]" : level.path + "." + key;
}

bool visit_numbers(std::span<const uint8_t> message,
                   const std::function<void(const NumberField&)>& visit) {
  const int size = static_cast<int>(message.size());
  const MessageType* type = find_message_type(message.data(), size);
  // Decoded once before anything is visited, so that a damaged message gives no values at all.
  if (type == nullptr || !type->decodes(message.data(), size)) return false;
  NumberVisitor visitor(visit);
  return walk_message(*find_message_layout(type->name), message, visitor);
}

}  // namespace nao
