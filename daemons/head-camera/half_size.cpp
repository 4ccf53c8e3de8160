#include "daemons/head-camera/half_size.h"

#include <cstring>

namespace nao::camera {
namespace {

/** Selects the bytes 0 and 2 of a pixel; the zeros above each leave room for the sum of four. */
constexpr uint32_t kEveryOther = 0x00ff00ff;
/** Adding 2 to both sums rounds the division by 4 to the nearest. */
constexpr uint32_t kRounding = 0x00020002;

uint32_t load(const uint8_t* pixel) {
  uint32_t value = 0;
  std::memcpy(&value, pixel, sizeof value);
  return value;
}

/** Rounded mean of each byte of four pixels, two bytes at once. */
uint32_t mean(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const uint32_t even =
      (a & kEveryOther) + (b & kEveryOther) + (c & kEveryOther) + (d & kEveryOther) + kRounding;
  const uint32_t odd = ((a >> 8) & kEveryOther) + ((b >> 8) & kEveryOther) +
                       ((c >> 8) & kEveryOther) + ((d >> 8) & kEveryOther) + kRounding;
  return ((even >> 2) & kEveryOther) | (((odd >> 2) & kEveryOther) << 8);
}

}  // namespace

// Box filter of 2 x 2 pixels. Widths and heights are even.
void halve(const std::vector<uint8_t>& pixels, int width, int height, std::vector<uint8_t>& half) {
  const int half_width = width / 2;
  const int half_height = height / 2;
  half.resize(static_cast<size_t>(4) * half_width * half_height);
  const size_t row_bytes = static_cast<size_t>(4) * width;
  for (int v = 0; v < half_height; ++v) {
    const uint8_t* upper = pixels.data() + 2 * v * row_bytes;
    const uint8_t* lower = upper + row_bytes;
    uint8_t* result = half.data() + static_cast<size_t>(4) * half_width * v;
    for (int u = 0; u < half_width; ++u) {
      const uint32_t pixel = mean(load(upper + 8 * u), load(upper + 8 * u + 4), load(lower + 8 * u),
                                  load(lower + 8 * u + 4));
      std::memcpy(result + 4 * u, &pixel, sizeof pixel);
    }
  }
}

}  // namespace nao::camera
