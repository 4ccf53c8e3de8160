#include "daemons/head-camera/exposure.h"

#include <cstddef>

namespace nao::camera {

void Exposure::clear() {
  sums_.clear();
  num_images_ = 0;
}

void Exposure::add(const std::vector<uint8_t>& pixels) {
  sums_.resize(pixels.size(), 0);
  // 16 bits hold the sum of 257 images of 8 bits.
  for (size_t i = 0; i < pixels.size(); ++i) sums_[i] = static_cast<uint16_t>(sums_[i] + pixels[i]);
  ++num_images_;
}

void Exposure::mean(std::vector<uint8_t>& pixels) const {
  pixels.resize(sums_.size());
  // Rounded to the nearest.
  for (size_t i = 0; i < sums_.size(); ++i) {
    pixels[i] = static_cast<uint8_t>((sums_[i] + num_images_ / 2) / num_images_);
  }
}

}  // namespace nao::camera
