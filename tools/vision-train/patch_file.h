#pragma once

#include <array>
#include <filesystem>
#include <opencv2/core.hpp>

#include "common/output_file.h"

namespace nao::vision {

/** File of patches for training: records of 32 x 32 x 3 bytes (rows, blue first) and 8 numbers of
 * 32 bits, little-endian. train.py reads it. */
class PatchFile {
 public:
  /** Numbers of a record: class, targets of the regression, and where the patch comes from. */
  using Numbers = std::array<float, 8>;

  /** @throws Error  if it cannot be written. */
  explicit PatchFile(const std::filesystem::path& file) : file_(file) {}

  void add(const cv::Mat& patch, const Numbers& numbers);
  /** @throws Error  if it could not be written. */
  void close() { file_.finish(); }
  int num_records() const { return num_records_; }

 private:
  OutputFile file_;
  int num_records_ = 0;
};

}  // namespace nao::vision
