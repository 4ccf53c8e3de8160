#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "message_reflection/message_layout.h"

namespace nao {

/** Converts messages of one type to rows of a table. Each field and each element of an array has a
 * column, such as joint_position[HeadYaw] or position_torso_in_odometry[0]; the column of a byte
 * array holds its length. Columns are in the order of their first occurrence. */
class MessageTable {
 public:
  explicit MessageTable(const MessageLayout& layout) : layout_(&layout) {}

  /** Adds columns for all values of a message. @return false if the bytes are not a message of the
   * type. */
  bool see(std::span<const uint8_t> message);

  /** Names of all columns, comma-separated, without a line end. */
  std::string heading() const;

  /** Values of a message in all columns: empty where it has none; non-finite numbers are "nan",
   * "inf" or "-inf". "" if the bytes are not a message of the type. */
  std::string row(std::span<const uint8_t> message) const;

 private:
  const MessageLayout* layout_;
  std::map<std::string, size_t> columns_;
  std::vector<std::string> names_;
};

/** Value for a CSV file, quoted if necessary (RFC 4180). */
std::string csv_quoted(const std::string& text);

}  // namespace nao
