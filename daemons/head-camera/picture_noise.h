#pragma once

#include <cstdint>
#include <vector>

namespace nao {

/** Noise of a picture sensor: the same for the same seed and time. */
class PictureNoise {
 public:
  /** @param deviation  Standard deviation of each colour, of 255 levels. */
  explicit PictureNoise(double deviation);

  /** @param bgrx  4 bytes a pixel; the fourth stays. @param utime  Makes each picture's noise
   * another. */
  void add(std::vector<uint8_t>& bgrx, int64_t utime) const;

 private:
  std::vector<int8_t> samples_;
};

}  // namespace nao
