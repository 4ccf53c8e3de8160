#pragma once

#include <cstdint>
#include <vector>

namespace nao::camera {

/** Gaussian noise of an image sensor, reproducible: the same at the same time. */
class ImageNoise {
 public:
  /** @param deviation  Standard deviation of each color, of 255 levels. */
  explicit ImageNoise(double deviation);

  /** Adds noise to an image; the result is clipped to 0 to 255.
   * @param bgrx  4 bytes a pixel; the fourth is not changed. @param utime  Seed of the noise. */
  void add(std::vector<uint8_t>& bgrx, int64_t utime) const;

 private:
  /** Samples of the distribution, rounded. */
  std::vector<int8_t> samples_;
};

}  // namespace nao::camera
