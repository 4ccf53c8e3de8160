#include "message_reflection/message_layout.h"

#include <iterator>
#include <sstream>

#include "message_reflection/layout_table.h"

namespace nao {
namespace {

std::vector<std::string> words(const char* text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

MessageLayout to_layout(const MessageRow& row) {
  MessageLayout layout{row.name, row.description, {}};
  for (const FieldRow& field : row.fields) {
    layout.fields.push_back(
        {field.kind, field.type, field.name, words(field.dimensions), field.description, {}});
    for (const ConstantRow& constant : field.constants) {
      layout.fields.back().constants.push_back({constant.name, constant.value});
    }
  }
  return layout;
}

}  // namespace

const std::vector<MessageLayout>& message_layouts() {
  static const std::vector<MessageLayout> kLayouts = [] {
    std::vector<MessageLayout> layouts;
    for (const MessageRow& row : layout_table()) layouts.push_back(to_layout(row));
    return layouts;
  }();
  return kLayouts;
}

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
