#pragma once

#include <cstdint>
#include <span>

#include "message_reflection/message_layout.h"

namespace nao {

// Types of the constants that generate_message_layouts.py writes, which cost the compiler nothing.
// message_layouts() makes strings and lists of them.

struct ConstantRow {
  const char* name;
  int64_t value;
};

struct FieldRow {
  FieldKind kind;
  const char* type;
  const char* name;
  /** Separated by spaces, outermost first. */
  const char* dimensions;
  const char* description;
  std::span<const ConstantRow> constants;
};

struct MessageRow {
  const char* name;
  const char* description;
  std::span<const FieldRow> fields;
};

/** In alphabetical order. */
std::span<const MessageRow> layout_table();

}  // namespace nao
