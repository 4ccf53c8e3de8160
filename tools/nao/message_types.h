#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nao {

/** One type of message that the project knows. */
struct MessageType {
  /** As in its .lcm file: "robot_state_t". */
  std::string name;
  /** What LCM puts in front of every message of this type; changes whenever a field does. */
  int64_t fingerprint = 0;
  /** @return true if `size` bytes at `data` are exactly one message of this type. */
  bool (*decodes)(const void* data, int size) = nullptr;
};

/** Every type of lcmtypes/, in alphabetical order. */
const std::vector<MessageType>& message_types();

/** Type of an encoded message.
 * @return nullptr if its fingerprint is unknown: not the project's, or from another version. */
const MessageType* find_message_type(const void* data, int size);

}  // namespace nao
