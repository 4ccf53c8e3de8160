#include "robot_model/closest_points.h"

#include <gtest/gtest.h>

#include "common/random.h"

namespace nao {
namespace {

using Eigen::Vector3d;

RoundedBox box(const Vector3d& center, const Vector3d& half, double radius) {
  RoundedBox result;
  result.center = center;
  result.half = half;
  result.radius = radius;
  return result;
}

RoundedBox random_box(Random& random, double apart, int num_extents) {
  RoundedBox result;
  for (double& x : result.center) x = random.uniform(-apart, apart);
  result.rotation =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
          .normalized()
          .toRotationMatrix();
  for (int i = 0; i < num_extents; ++i) result.half[2 - i] = random.uniform(0.01, 0.1);
  result.radius = random.uniform(0.005, 0.03);
  return result;
}

/** Distance of two inner boxes by alternating projections: slow and simple. */
double slow_distance(const RoundedBox& a, const RoundedBox& b) {
  Vector3d point = a.center;
  double distance = 0;
  for (int i = 0; i < 20000; ++i) {
    const RoundedBox& onto = i % 2 == 0 ? b : a;
    const Vector3d local = onto.rotation.transpose() * (point - onto.center);
    const Vector3d nearest =
        onto.center + onto.rotation * local.cwiseMax(-onto.half).cwiseMin(onto.half);
    distance = (nearest - point).norm();
    point = nearest;
  }
  return distance;
}

TEST(ClosestPoints, ConnectsSpheresAlongTheLineOfTheirCenters) {
  const Proximity found =
      closest_points(box({0, 0, 1}, {0, 0, 0}, 0.3), box({0, 0, 0}, {0, 0, 0}, 0.5));
  EXPECT_NEAR(found.distance, 0.2, 1e-12);
  EXPECT_LT((found.normal - Vector3d(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((found.point - Vector3d(0, 0, 0.6)).norm(), 1e-12);
}

TEST(ClosestPoints, AgreesWithAlternatingProjections) {
  Random random(5);
  int num_compared = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const RoundedBox a = random_box(random, 0.3, trial % 4);
    const RoundedBox b = random_box(random, 0.3, (trial / 4) % 4);
    const double expected = slow_distance(a, b);
    if (expected < 1e-3) continue;
    ++num_compared;
    const Proximity found = closest_points(a, b);
    EXPECT_NEAR(found.distance, expected - a.radius - b.radius, 1e-5) << "trial " << trial;
    const Proximity swapped = closest_points(b, a);
    EXPECT_NEAR(found.distance, swapped.distance, 1e-6) << "trial " << trial;
    EXPECT_LT((found.normal + swapped.normal).norm(), 1e-3) << "trial " << trial;
  }
  EXPECT_GT(num_compared, 100);
}

TEST(ClosestPoints, SeparatesOverlappingInnerBoxesAlongTheLeastOverlap) {
  const Proximity found = closest_points(box({0.01, 0, 0.18}, {0.1, 0.1, 0.1}, 0.01),
                                         box({0, 0, 0}, {0.2, 0.2, 0.1}, 0));
  EXPECT_NEAR(found.distance, -0.02 - 0.01, 1e-9);
  EXPECT_LT((found.normal - Vector3d(0, 0, 1)).norm(), 1e-9);
}

}  // namespace
}  // namespace nao
