#pragma once

#include <cstdint>
#include <vector>

namespace nao {

/** Mean of pictures of one size: what a shutter that is open for a while collects. */
class Exposure {
 public:
  void clear();
  void add(const std::vector<uint8_t>& pixels);
  /** @param pixels  Resized; rounded mean of what was added. */
  void mean(std::vector<uint8_t>& pixels) const;

 private:
  std::vector<uint16_t> sums_;
  uint16_t num_pictures_ = 0;
};

}  // namespace nao
