#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nao {

/** Identity of one message type. */
struct MessageType {
  /** As in its .lcm file: "robot_state_t". */
  std::string name;
  /** First 8 bytes of every message of this type; LCM derives it from the names and types of the
   * fields, so it changes whenever a field changes. */
  int64_t fingerprint = 0;
  /** @return true if the `size` bytes at `data` are exactly one message of this type. */
  bool (*decodes)(const void* data, int size) = nullptr;
};

/** All types of lcmtypes/, in alphabetical order. */
const std::vector<MessageType>& message_types();

/** Type of an encoded message.
 * @return nullptr if no type has its fingerprint: the message is not this project's, or was sent by
 *   another version of it. */
const MessageType* find_message_type(const void* data, int size);

}  // namespace nao
