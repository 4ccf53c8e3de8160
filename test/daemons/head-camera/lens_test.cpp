#include "daemons/head-camera/lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "daemons/head-camera/exposure.h"
#include "daemons/head-camera/picture_noise.h"

namespace nao {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

PinholeCamera camera() {
  return PinholeCamera::from_fov(kWidth, kHeight, 0.983, 0.763);
}

std::vector<uint8_t> plain(uint8_t value) {
  return std::vector<uint8_t>(static_cast<size_t>(4) * kWidth * kHeight, value);
}

/** Black, with a round bright spot of a few pixels; v runs down, rows run up. */
std::vector<uint8_t> spot(const Eigen::Vector2d& centre) {
  std::vector<uint8_t> pixels = plain(0);
  for (int row = 0; row < kHeight; ++row) {
    for (int u = 0; u < kWidth; ++u) {
      const Eigen::Vector2d offset(u - centre.x(), kHeight - 1 - row - centre.y());
      const double value = 255 * std::exp(-offset.squaredNorm() / 8);
      std::fill_n(pixels.begin() + 4 * (static_cast<ptrdiff_t>(row) * kWidth + u), 4,
                  static_cast<uint8_t>(value));
    }
  }
  return pixels;
}

Eigen::Vector2d centroid(const std::vector<uint8_t>& pixels) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int u = 0; u < kWidth; ++u) {
      const double value = pixels[4 * (static_cast<size_t>(row) * kWidth + u)];
      sum += value * Eigen::Vector2d(u, kHeight - 1 - row);
      weight += value;
    }
  }
  return sum / weight;
}

class LensModel : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(LensModel, ShowsAPointWhereTheFormulaPutsIt) {
  const auto [k1, k2] = GetParam();
  const Lens lens(camera(), k1, k2);
  for (const auto& [x, y] : {std::pair{0.3, 0.1}, {-0.25, 0.3}, {0.1, -0.35}, {-0.45, -0.2}}) {
    std::vector<uint8_t> bent;
    lens.bend(spot(lens.source().project({1, -x, -y})), bent);
    const double square = x * x + y * y;
    const double factor = 1 + k1 * square + k2 * square * square;
    const Eigen::Vector2d expected = camera().project({1, -x * factor, -y * factor});
    EXPECT_LT((centroid(bent) - expected).norm(), 0.3) << x << ", " << y;
  }
}

TEST_P(LensModel, FillsThePictureToItsCorners) {
  const auto [k1, k2] = GetParam();
  const Lens lens(camera(), k1, k2);
  std::vector<uint8_t> bent;
  lens.bend(plain(200), bent);
  EXPECT_EQ(bent, plain(200));
  EXPECT_EQ(lens.source().width, kWidth);
  if (k1 < 0) {
    EXPECT_LT(lens.source().fx, camera().fx);
  } else {
    EXPECT_DOUBLE_EQ(lens.source().fx, camera().fx);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LensModel,
                         testing::Values(std::pair{-0.3, 0.1}, std::pair{0.2, 0.0},
                                         std::pair{0.0, 0.0}));

TEST(Lens, RefusesToFoldThePicture) {
  EXPECT_THROW(Lens(camera(), -2, 0), ConfigError);
}

TEST(PictureNoise, HasTheDeviationAskedForAndRepeats) {
  const PictureNoise noise(5);
  std::vector<uint8_t> pixels = plain(128);
  noise.add(pixels, 1000);
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (i % 4 == 3) {
      ASSERT_EQ(pixels[i], 128) << "the byte that is no colour";
      continue;
    }
    sum += pixels[i] - 128;
    squares += (pixels[i] - 128) * (pixels[i] - 128);
    ++count;
  }
  EXPECT_NEAR(sum / count, 0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count), 5, 0.1);
  std::vector<uint8_t> again = plain(128);
  noise.add(again, 1000);
  EXPECT_EQ(again, pixels);
  std::vector<uint8_t> later = plain(128);
  noise.add(later, 34000);
  EXPECT_NE(later, pixels);
}

TEST(PictureNoise, StaysWithinWhite) {
  std::vector<uint8_t> pixels = plain(254);
  PictureNoise(20).add(pixels, 1);
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
}  // namespace nao
