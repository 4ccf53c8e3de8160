#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nao {

/** The types of fields in LCM's language. */
enum class FieldKind {
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kFloat,
  kDouble,
  kBoolean,
  kByte,
  kString,
  kStruct
};

/** A named value of an integer field, such as STATUS_DONE = 2. */
struct EnumConstant {
  /** As in the .lcm file. */
  std::string name;
  int64_t value = 0;
};

/** One field of a message. */
struct FieldLayout {
  FieldKind kind = FieldKind::kInt8;
  /** As in the .lcm file; for a struct, the name of its layout. */
  std::string type;
  std::string name;
  /** Lengths of an array, outermost first: digits, or the name of the field that holds the length.
   */
  std::vector<std::string> dimensions;
  /** The comment above the field: meaning, unit, frame. */
  std::string description;
  /** Enumeration of an integer field: the constants of the same message and type whose names begin
   * with the field's name, as STATUS_DONE for `status`; empty for other fields. */
  std::vector<EnumConstant> constants;
};

/** The content of a message, in the order of the wire format. */
struct MessageLayout {
  /** As in its .lcm file: "robot_state_t". */
  std::string name;
  std::string description;
  std::vector<FieldLayout> fields;
};

/** All types of lcmtypes/, in alphabetical order. The code is generated from the .lcm files. */
const std::vector<MessageLayout>& message_layouts();

/** @return nullptr if there is no type of this name. */
const MessageLayout* find_message_layout(const std::string& name);

/** Name of the constant of `field` that has this value, such as "STATUS_DONE".
 * @return nullptr if no constant has it. */
const std::string* find_constant_name(const FieldLayout& field, int64_t value);

}  // namespace nao
