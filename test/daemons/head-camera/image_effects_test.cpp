#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "daemons/head-camera/exposure.h"
#include "daemons/head-camera/image_noise.h"

namespace nao::camera {
namespace {

std::vector<uint8_t> plain(uint8_t value) {
  return std::vector<uint8_t>(static_cast<size_t>(4) * 640 * 480, value);
}

TEST(ImageNoise, HasTheGivenDeviationAndIsReproducible) {
  const ImageNoise noise(5);
  std::vector<uint8_t> pixels = plain(128);
  noise.add(pixels, 1000);
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (i % 4 == 3) {
      ASSERT_EQ(pixels[i], 128) << "the byte that is not a color";
      continue;
    }
    sum += pixels[i] - 128;
    squares += (pixels[i] - 128) * (pixels[i] - 128);
    ++count;
  }
  EXPECT_NEAR(sum / count, 0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count), 5, 0.1);
  std::vector<uint8_t> repeated = plain(128);
  noise.add(repeated, 1000);
  EXPECT_EQ(repeated, pixels);
  std::vector<uint8_t> later = plain(128);
  noise.add(later, 34000);
  EXPECT_NE(later, pixels);
}

TEST(ImageNoise, IsClippedAtWhite) {
  std::vector<uint8_t> pixels = plain(254);
  ImageNoise(20).add(pixels, 1);
  EXPECT_GT(*std::min_element(pixels.begin(), pixels.end()), 100);
}

TEST(Exposure, IsTheRoundedMean) {
  Exposure exposure;
  exposure.add({10, 255, 0});
  exposure.add({11, 255, 0});
  exposure.add({11, 255, 1});
  std::vector<uint8_t> mean;
  exposure.mean(mean);
  EXPECT_EQ(mean, (std::vector<uint8_t>{11, 255, 0}));
  exposure.clear();
  exposure.add({7, 7, 7});
  exposure.mean(mean);
  EXPECT_EQ(mean, (std::vector<uint8_t>{7, 7, 7}));
}

}  // namespace
}  // namespace nao::camera
