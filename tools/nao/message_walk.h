#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tools/nao/message_layout.h"

namespace nao {

/** Receives the fields of a message, in their order. The key of a list's element is its label: what
 * the list of names of the same length says, such as a joint's name, or else its number. */
class MessageVisitor {
 public:
  virtual ~MessageVisitor() = default;
  virtual void begin_struct(const std::string& key) = 0;
  virtual void end_struct() = 0;
  virtual void begin_list(const std::string& key) = 0;
  virtual void end_list() = 0;
  virtual void integer(const std::string& key, int64_t value) = 0;
  virtual void number(const std::string& key, double value) = 0;
  virtual void boolean(const std::string& key, bool value) = 0;
  virtual void text(const std::string& key, const std::string& value) = 0;
  virtual void bytes(const std::string& key, std::span<const uint8_t> value) = 0;
};

/** Walks through an encoded message whose type is known: its fields, without the struct around
 * them.
 * @param message  Whole, with the fingerprint.
 * @return false if the bytes are not such a message; what was visited before is then void. */
[[nodiscard]] bool walk_message(const MessageLayout& layout, std::span<const uint8_t> message,
                                MessageVisitor& visitor);

}  // namespace nao
