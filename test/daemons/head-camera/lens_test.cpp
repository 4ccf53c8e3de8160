#include "daemons/head-camera/lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace nao::camera {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

PinholeCamera camera() {
  return PinholeCamera::from_fov(kWidth, kHeight, 0.983, 0.763);
}

std::vector<uint8_t> plain_image(uint8_t value) {
  return std::vector<uint8_t>(static_cast<size_t>(4) * kWidth * kHeight, value);
}

/** Black, with a bright round spot of a few pixels; v runs down, rows run up. */
std::vector<uint8_t> spot(const Eigen::Vector2d& center) {
  std::vector<uint8_t> pixels = plain_image(0);
  for (int row = 0; row < kHeight; ++row) {
    for (int u = 0; u < kWidth; ++u) {
      const Eigen::Vector2d offset(u - center.x(), kHeight - 1 - row - center.y());
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

class LensModel : public testing::TestWithParam<Distortion> {};

TEST_P(LensModel, ShowsAPointAtThePixelThatTheFormulaGives) {
  const Lens lens(camera(), GetParam());
  for (const auto& [x, y] : {std::pair{0.3, 0.1}, {-0.25, 0.3}, {0.1, -0.35}, {-0.45, -0.2}}) {
    std::vector<uint8_t> image;
    lens.distort(spot(lens.source().project({1, -x, -y})), image);
    const Eigen::Vector2d point = distorted(GetParam(), {x, y});
    const Eigen::Vector2d expected(camera().cx + camera().fx * point.x(),
                                   camera().cy + camera().fy * point.y());
    EXPECT_LT((centroid(image) - expected).norm(), 0.3) << x << ", " << y;
  }
}

TEST_P(LensModel, FillsTheImageUpToItsCorners) {
  const Lens lens(camera(), GetParam());
  std::vector<uint8_t> image;
  lens.distort(plain_image(200), image);
  EXPECT_EQ(image, plain_image(200));
  EXPECT_EQ(lens.source().width, kWidth);
  EXPECT_LE(lens.source().fx, camera().fx);
  // No pixel of the border shows a point outside of the source image.
  for (const auto& [u, v] : {std::pair{0, 0}, {639, 0}, {0, 479}, {639, 479}, {320, 0}, {0, 240}}) {
    const Eigen::Vector2d point =
        undistorted(GetParam(), {(u - camera().cx) / camera().fx, (v - camera().cy) / camera().fy});
    const Eigen::Vector2d pixel = lens.source().project({1, -point.x(), -point.y()});
    EXPECT_GT(pixel.minCoeff(), -1e-6);
    EXPECT_LT(pixel.x(), kWidth - 1 + 1e-6);
    EXPECT_LT(pixel.y(), kHeight - 1 + 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, LensModel,
    testing::Values(Distortion{}, Distortion{.k1 = -0.3, .k2 = 0.1}, Distortion{.k1 = 0.2},
                    Distortion{.k3 = 0.3}, Distortion{.p1 = 0.02, .p2 = -0.03},
                    Distortion{.k1 = -0.2, .k2 = 0.05, .p1 = 0.005, .p2 = 0.01, .k3 = -0.02}));

TEST(Lens, RendersWithAShorterFocalLengthForABarrelOnly) {
  EXPECT_LT(Lens(camera(), {.k1 = -0.3, .k2 = 0.1}).source().fx, camera().fx);
  EXPECT_DOUBLE_EQ(Lens(camera(), {.k1 = 0.2}).source().fx, camera().fx);
  EXPECT_DOUBLE_EQ(Lens(camera(), {}).source().fx, camera().fx);
}

TEST(Lens, RejectsADistortionThatFoldsTheImage) {
  EXPECT_THROW(Lens(camera(), {.k1 = -2}), ConfigError);
}

}  // namespace
}  // namespace nao::camera
