#include "message_reflection/message_layout.h"

namespace nao {

const MessageLayout* find_message_layout(const std::string& name) {
  for (const MessageLayout& layout : message_layouts()) {
    if (layout.name == name) return &layout;
  }
  return nullptr;
}

const std::string* find_constant_name(const FieldLayout& field, int64_t value) {
  for (const EnumConstant& constant : field.constants) {
    if (constant.value == value) return &constant.name;
  }
  return nullptr;
}

}  // namespace nao
