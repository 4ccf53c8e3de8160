#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nao::playback {

/** One recorded number of every row: a quantity of one joint, sensor or axis. */
struct GoldenColumn {
  /** Such as "joint_position". */
  std::string quantity;
  /** Joint, sensor or axis; "-" if there is only one. */
  std::string name;
  /** Every value is a whole multiple of this; unit of the quantity. */
  double resolution = 1;
};

/** Numbers of a recorded run, one row for each control tick, independent of any message type.
 *
 * File: a line "golden table 1", a line "rows N", a line "column QUANTITY NAME RESOLUTION" for each
 * column (resolution as a hexadecimal floating-point number), a line "data", then row by row, for
 * each column, the change of value / resolution since the row before (the first: since 0) as a
 * zigzag varint (base 128, least significant group first, as in protobuf). */
class GoldenTable {
 public:
  /** @throws Error  if the file is missing or is not a complete table. */
  explicit GoldenTable(const std::filesystem::path& file);

  size_t num_rows() const { return num_rows_; }
  const std::vector<GoldenColumn>& columns() const { return columns_; }

  /** Names of all columns of a quantity, in their order. */
  std::vector<std::string> names(const std::string& quantity) const;
  /** A row's values of all columns of a quantity, in the order of names(); unit of the quantity.
   * Empty if the table has none. */
  std::vector<double> values(size_t row, const std::string& quantity) const;
  /** A row's control tick, from the column "tick". */
  int64_t tick(size_t row) const;

 private:
  std::vector<GoldenColumn> columns_;
  size_t num_rows_ = 0;
  /** Row by row. */
  std::vector<double> values_;
};

}  // namespace nao::playback
