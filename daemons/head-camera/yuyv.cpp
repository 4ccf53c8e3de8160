#include "daemons/head-camera/yuyv.h"

#include <algorithm>

namespace nao::camera {
namespace {

/** Fixed-point numbers with 16 bits after the point. */
constexpr int kBits = 16;
constexpr int kHalf = 1 << (kBits - 1);
constexpr int fixed(double value) {
  return static_cast<int>(value * (1 << kBits) + (value < 0 ? -0.5 : 0.5));
}

uint8_t to_byte(int value) {
  return static_cast<uint8_t>(std::clamp((value + kHalf) >> kBits, 0, 255));
}

}  // namespace

// R = Y + 1.402 (Cr - 128), G = Y - 0.344136 (Cb - 128) - 0.714136 (Cr - 128),
// B = Y + 1.772 (Cb - 128).
void yuyv_to_bgrx(std::span<const uint8_t> yuyv, int width, int height,
                  std::vector<uint8_t>& bgrx) {
  const auto row_bytes = static_cast<size_t>(4) * width;
  bgrx.resize(row_bytes * height);
  for (int v = 0; v < height; ++v) {
    const uint8_t* source = yuyv.data() + static_cast<size_t>(2) * width * v;
    uint8_t* pixel = bgrx.data() + row_bytes * (height - 1 - v);
    for (int pair = 0; pair < width / 2; ++pair, source += 4, pixel += 8) {
      const int cb = source[1] - 128;
      const int cr = source[3] - 128;
      const int red = fixed(1.402) * cr;
      const int green = fixed(-0.344136) * cb + fixed(-0.714136) * cr;
      const int blue = fixed(1.772) * cb;
      for (int i = 0; i < 2; ++i) {
        const int y = source[2 * i] << kBits;
        pixel[4 * i] = to_byte(y + blue);
        pixel[4 * i + 1] = to_byte(y + green);
        pixel[4 * i + 2] = to_byte(y + red);
        pixel[4 * i + 3] = 255;
      }
    }
  }
}

void bgrx_to_yuyv(const std::vector<uint8_t>& bgrx, int width, int height,
                  std::span<uint8_t> yuyv) {
  const auto row_bytes = static_cast<size_t>(4) * width;
  for (int v = 0; v < height; ++v) {
    const uint8_t* pixel = bgrx.data() + row_bytes * (height - 1 - v);
    uint8_t* target = yuyv.data() + static_cast<size_t>(2) * width * v;
    for (int pair = 0; pair < width / 2; ++pair, pixel += 8, target += 4) {
      for (int i = 0; i < 2; ++i) {
        target[2 * i] = to_byte(fixed(0.114) * pixel[4 * i] + fixed(0.587) * pixel[4 * i + 1] +
                                fixed(0.299) * pixel[4 * i + 2]);
      }
      // Sums of two: half of each coefficient.
      const int blue = pixel[0] + pixel[4];
      const int green = pixel[1] + pixel[5];
      const int red = pixel[2] + pixel[6];
      target[1] = to_byte((128 << kBits) + fixed(0.25) * blue + fixed(-0.165632) * green +
                          fixed(-0.084368) * red);
      target[3] = to_byte((128 << kBits) + fixed(0.25) * red + fixed(-0.209344) * green +
                          fixed(-0.040656) * blue);
    }
  }
}

}  // namespace nao::camera
