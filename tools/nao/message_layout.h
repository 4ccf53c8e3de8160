#pragma once

#include <string>
#include <vector>

namespace nao {

/** The kinds of fields of LCM's language. */
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

/** One field of a message. */
struct FieldLayout {
  FieldKind kind = FieldKind::kInt8;
  /** As in the .lcm file; for a struct, the name of its layout. */
  std::string type;
  std::string name;
  /** Lengths of a list, outermost first: digits, or the name of the field that holds it. */
  std::vector<std::string> dimensions;
  /** Comment above it: meaning, unit, frame. */
  std::string description;
};

/** What is in a message, in the order of the wire. */
struct MessageLayout {
  /** As in its .lcm file: "robot_state_t". */
  std::string name;
  std::string description;
  std::vector<FieldLayout> fields;
};

/** Every type of lcmtypes/, in alphabetical order. The code is generated from the .lcm files. */
const std::vector<MessageLayout>& message_layouts();

/** @return nullptr if there is none of this name. */
const MessageLayout* find_message_layout(const std::string& name);

}  // namespace nao
