#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "message_reflection/message_layout.h"

namespace nao {

/** Receives the fields of a message in the order of the wire format.
 *
 * The key of a field is its name. The key of an array element is its label: the entry of the string
 * array of the same length, such as a joint's name, else the element's index. */
class MessageVisitor {
 public:
  virtual ~MessageVisitor() = default;
  virtual void begin_struct(const std::string& key) = 0;
  virtual void end_struct() = 0;
  virtual void begin_list(const std::string& key) = 0;
  virtual void end_list() = 0;
  virtual void integer(const std::string& key, int64_t value) = 0;
  /** An integer that equals a constant of its field; handled as integer() by default.
   * @param constant  Name of the constant, such as "STATUS_DONE". */
  virtual void enumerator(const std::string& key, int64_t value, const std::string& constant);
  virtual void number(const std::string& key, double value) = 0;
  virtual void boolean(const std::string& key, bool value) = 0;
  virtual void text(const std::string& key, const std::string& value) = 0;
  virtual void bytes(const std::string& key, std::span<const uint8_t> value) = 0;
};

/** Visits the fields of an encoded message of a known type; the outermost struct itself is not
 * visited.
 * @param message  The whole message, with its fingerprint.
 * @return false if the bytes are not a message of this type; what was visited is then invalid. */
[[nodiscard]] bool walk_message(const MessageLayout& layout, std::span<const uint8_t> message,
                                MessageVisitor& visitor);

}  // namespace nao
