#pragma once

#include <cstdint>
#include <vector>

namespace nao::camera {

/** Mean of images of one size: motion blur is the mean of images taken during the exposure. */
class Exposure {
 public:
  void clear();
  /** Adds an image; at most 257 between two calls of clear(). */
  void add(const std::vector<uint8_t>& pixels);
  /** Rounded mean of the images; at least one must have been added. @param pixels  Resized. */
  void mean(std::vector<uint8_t>& pixels) const;

 private:
  std::vector<uint16_t> sums_;
  uint16_t num_images_ = 0;
};

}  // namespace nao::camera
