#include "daemons/head-camera/jpeg_encoder.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cmath>
#include <random>

#include "common/error.h"
#include "daemons/head-camera/half_size.h"

namespace nao::camera {
namespace {

std::vector<uint8_t> noise(int width, int height) {
  std::mt19937 random(1);
  std::vector<uint8_t> pixels(static_cast<size_t>(4) * width * height);
  for (uint8_t& value : pixels) value = static_cast<uint8_t>(random());
  return pixels;
}

std::vector<uint8_t> decode(const std::vector<uint8_t>& jpeg, int width, int height) {
  tjhandle handle = tjInitDecompress();
  std::vector<uint8_t> pixels(static_cast<size_t>(4) * width * height);
  EXPECT_EQ(tjDecompress2(handle, jpeg.data(), jpeg.size(), pixels.data(), width, 0, height,
                          TJPF_BGRX, TJFLAG_BOTTOMUP),
            0);
  tjDestroy(handle);
  return pixels;
}

TEST(JpegEncoder, KeepsTheImageAndItsOrientation) {
  constexpr int kWidth = 64;
  constexpr int kHeight = 48;
  std::vector<uint8_t> pixels;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      pixels.insert(pixels.end(),
                    {static_cast<uint8_t>(5 * v), static_cast<uint8_t>(4 * u), 60, 255});
    }
  }
  JpegEncoder encoder;
  const auto decoded = decode(encoder.encode(pixels, kWidth, kHeight, 95, 60000), kWidth, kHeight);
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (i % 4 == 3) continue;  // unused
    ASSERT_NEAR(decoded[i], pixels[i], 14) << i;
  }
}

TEST(JpegEncoder, LowersTheQualityUntilTheFileFits) {
  JpegEncoder encoder;
  const auto pixels = noise(640, 480);
  EXPECT_GT(encoder.encode(pixels, 640, 480, 95, 10000000).size(), 64000u);
  const auto jpeg = encoder.encode(pixels, 640, 480, 95, 64000);
  EXPECT_LE(jpeg.size(), 64000u);
  decode(jpeg, 640, 480);
  // The next image is encoded with its full quality.
  EXPECT_GT(encoder.encode(pixels, 640, 480, 95, 10000000).size(), 64000u);
}

TEST(JpegEncoder, RejectsWrongSizesAndLimitsItCannotReach) {
  JpegEncoder encoder;
  EXPECT_THROW(encoder.encode(noise(8, 8), 16, 16, 80, 60000), Error);
  EXPECT_THROW(encoder.encode({}, 0, 0, 80, 60000), Error);
  EXPECT_THROW(encoder.encode({}, -1, -1, 80, 60000), Error);
  EXPECT_THROW(encoder.encode(noise(640, 480), 640, 480, 80, 100), Error);
}

TEST(HalfSize, IsTheRoundedMeanOfFourPixels) {
  constexpr int kWidth = 26;
  constexpr int kHeight = 14;
  const auto pixels = noise(kWidth, kHeight);
  std::vector<uint8_t> half;
  halve(pixels, kWidth, kHeight, half);
  ASSERT_EQ(half.size(), pixels.size() / 4);
  const auto at = [&](int u, int v, int channel) {
    return static_cast<int>(pixels[4 * (v * kWidth + u) + channel]);
  };
  for (int v = 0; v < kHeight / 2; ++v) {
    for (int u = 0; u < kWidth / 2; ++u) {
      for (int channel = 0; channel < 4; ++channel) {
        const int sum = at(2 * u, 2 * v, channel) + at(2 * u + 1, 2 * v, channel) +
                        at(2 * u, 2 * v + 1, channel) + at(2 * u + 1, 2 * v + 1, channel);
        ASSERT_EQ(half[4 * (v * kWidth / 2 + u) + channel], (sum + 2) / 4);
      }
    }
  }
}

}  // namespace
}  // namespace nao::camera
