#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "message_reflection/message_layout.h"
#include "message_reflection/message_types.h"

namespace nao {

/** An encoded message, or why there is none. */
struct EncodedMessage {
  /** With its fingerprint; empty if there is a fault. */
  std::vector<uint8_t> bytes;
  /** A sentence that names the field; empty if there is none. */
  std::string fault;
};

/** Encodes a JSON object as a message: the reverse of message_to_json().
 *
 * Fields that are absent are 0, false, "" or empty. Lengths of arrays are those of the arrays
 * themselves; arrays that share a length must agree. null is an unknown number (NaN); an
 * enumeration is a number or the name of its constant. Byte arrays cannot be given.
 * @param type, layout  Of the same message. */
EncodedMessage message_from_json(const MessageType& type, const MessageLayout& layout,
                                 const nlohmann::json& object);

}  // namespace nao
