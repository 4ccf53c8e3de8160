#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "message_reflection/message_layout.h"

namespace nao {

/** Turns the messages of one type into the rows of a table: a column for every field, and for every
 * element of a list, such as joint_position[HeadYaw] or position_torso_in_odometry[0]; for bytes
 * the column says how many. Columns appear in the order in which they are first seen. */
class MessageTable {
 public:
  explicit MessageTable(const MessageLayout& layout) : layout_(&layout) {}

  /** Makes columns for whatever a message holds.
   * @return false if the bytes are no message of the type. */
  bool see(std::span<const uint8_t> message);

  /** One line of comma-separated values, without its end, of all columns. */
  std::string heading() const;

  /** The values of a message in all columns; empty where it has none, and where a number is not
   * finite "nan", "inf" or "-inf". "" if the bytes are no message of the type. */
  std::string row(std::span<const uint8_t> message) const;

 private:
  const MessageLayout* layout_;
  std::map<std::string, size_t> columns_;
  std::vector<std::string> names_;
};

/** A value for a CSV file: in quotes if it needs them (RFC 4180). */
std::string csv_quoted(const std::string& text);

}  // namespace nao
