#include "daemons/head-camera/distortion.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace nao::camera {
namespace {

TEST(Distortion, IsTheIdentityWithoutCoefficients) {
  EXPECT_TRUE(Distortion().is_zero());
  EXPECT_EQ(distorted({}, {0.3, -0.2}), Eigen::Vector2d(0.3, -0.2));
}

TEST(Distortion, AppliesEachCoefficientAsOpenCvDefinesIt) {
  // x = 0.5, y = -0.2: r^2 = 0.29, r^4 = 0.0841, r^6 = 0.024389. Products computed by hand.
  const Eigen::Vector2d point(0.5, -0.2);
  const auto expect_near = [&](const Distortion& distortion, double x, double y) {
    EXPECT_LT((distorted(distortion, point) - Eigen::Vector2d(x, y)).norm(), 1e-12);
  };
  expect_near({.k1 = 0.1}, 0.5 * 1.029, -0.2 * 1.029);
  expect_near({.k2 = 0.1}, 0.5 * 1.00841, -0.2 * 1.00841);
  expect_near({.k3 = 0.1}, 0.5 * 1.0024389, -0.2 * 1.0024389);
  // 2 p1 x y = -0.02, p1 (r^2 + 2 y^2) = 0.037; p2 (r^2 + 2 x^2) = 0.079, 2 p2 x y = -0.02.
  expect_near({.p1 = 0.1}, 0.5 - 0.02, -0.2 + 0.037);
  expect_near({.p2 = 0.1}, 0.5 + 0.079, -0.2 - 0.02);
}

TEST(Distortion, ListsTheCoefficientsInOpenCvsOrder) {
  const Distortion distortion{.k1 = 1, .k2 = 2, .p1 = 3, .p2 = 4, .k3 = 5};
  EXPECT_EQ(distortion.coefficients(), (std::array<double, 5>{1, 2, 3, 4, 5}));
}

TEST(Distortion, IsInvertedByUndistorted) {
  for (const Distortion& distortion :
       {Distortion{.k1 = -0.3, .k2 = 0.1}, Distortion{.k1 = 0.2},
        Distortion{.p1 = 0.01, .p2 = -0.02},
        Distortion{.k1 = -0.2, .k2 = 0.05, .p1 = 0.005, .p2 = 0.01, .k3 = -0.01}}) {
    for (const Eigen::Vector2d& point :
         {Eigen::Vector2d(0, 0), {0.5, 0.4}, {-0.53, 0.1}, {0.2, -0.4}}) {
      EXPECT_LT((undistorted(distortion, distorted(distortion, point)) - point).norm(), 1e-9);
    }
  }
}

TEST(Distortion, RejectsAPointWhereTheImageFolds) {
  EXPECT_THROW(undistorted({.k1 = -2}, {0.5, 0.4}), ConfigError);
  EXPECT_THROW(undistorted({.p2 = -2}, {0.5, 0}), ConfigError);
}

}  // namespace
}  // namespace nao::camera
