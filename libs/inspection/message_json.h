#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "message_reflection/message_layout.h"

namespace nao {

/** A message as a JSON object with the field names of its .lcm file. Non-finite numbers are null,
 * bytes are base64. The name of an enumeration's value follows in a field of its own, as in
 * "status":2,"status_name":"STATUS_DONE".
 * @return nullopt if the bytes are not a message of this type. */
[[nodiscard]] std::optional<std::string> message_to_json(const MessageLayout& layout,
                                                         std::span<const uint8_t> message);

/** The same of a decoded message. */
template <class Message>
std::string json_of(const Message& message) {
  std::vector<uint8_t> bytes(static_cast<size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, message.getEncodedSize());
  return *message_to_json(*find_message_layout(Message::getTypeName()), bytes);
}

/** JSON Schema of message_to_json() for a type; the descriptions are the comments of the .lcm file,
 * with their units.
 *
 * It stays within what Foxglove and Lichtblick read: every property has one type, "nullable" (as in
 * OpenAPI 3.0) marks null, and arrays of arrays are not described: these programs refuse a channel
 * whose schema has one, but show it if only the message has it. */
std::string json_schema_of(const MessageLayout& layout);

}  // namespace nao
