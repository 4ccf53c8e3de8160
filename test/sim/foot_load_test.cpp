#include "sim/foot_load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/random.h"
#include "sim/world.h"
#include "test/sim/test_robots.h"

namespace nao::sim {
namespace {

using Eigen::Vector2d;

Vector2d center_of(const std::vector<Vector2d>& positions, const std::vector<double>& fractions) {
  Vector2d center = Vector2d::Zero();
  for (size_t i = 0; i < positions.size(); ++i) center += fractions[i] * positions[i];
  return center;
}

void expect_valid(const std::vector<double>& fractions) {
  EXPECT_NEAR(std::accumulate(fractions.begin(), fractions.end(), 0.0), 1, 1e-9);
  for (const double fraction : fractions) EXPECT_GE(fraction, 0);
}

TEST(FootLoad, KeepsTheCenterOfPressureOnFourCorners) {
  // The left foot's sensors are not an exact rectangle.
  const std::vector<Vector2d> corners{
      {0.07025, 0.0299}, {0.07025, -0.0231}, {-0.03025, 0.0299}, {-0.02965, -0.0191}};
  FootLoad load(corners);
  for (double x = -0.025; x < 0.07; x += 0.01) {
    for (double y = -0.018; y < 0.029; y += 0.005) {
      const std::vector<double> fractions = load.distribute({x, y});
      expect_valid(fractions);
      EXPECT_LT((center_of(corners, fractions) - Vector2d(x, y)).norm(), 1e-9);
    }
  }
}

TEST(FootLoad, LoadsTheFrontSensorsOnlyAheadOfTheToes) {
  const std::vector<double> ahead =
      FootLoad({{0.07, 0.03}, {0.07, -0.02}, {-0.03, 0.03}, {-0.03, -0.02}}).distribute({0.095, 0});
  EXPECT_NEAR(ahead[0] + ahead[1], 1, 1e-12);
}

class SensorLayout : public testing::TestWithParam<std::vector<Vector2d>> {};

TEST_P(SensorLayout, KeepsTheCenterOfPressureWithinTheSensorsHull) {
  const std::vector<Vector2d>& positions = GetParam();
  FootLoad load(positions);
  Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    // A random convex combination is within the hull.
    std::vector<double> weights(positions.size());
    for (double& weight : weights) weight = -std::log(1 - random.uniform());
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights) weight /= sum;
    const Vector2d point = center_of(positions, weights);
    const std::vector<double> fractions = load.distribute(point);
    expect_valid(fractions);
    EXPECT_LT((center_of(positions, fractions) - point).norm(), 1e-9);
  }
}

/** Distance of a point from the convex hull of positions outside of which it lies, m. The nearest
 * point of the hull is on an edge, and every line between two positions is within the hull. */
double distance_to_hull(const std::vector<Vector2d>& positions, const Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2d& a : positions) {
    for (const Vector2d& b : positions) {
      const Vector2d along = b - a;
      const double length_squared = along.squaredNorm();
      const double t =
          length_squared > 0 ? std::clamp((point - a).dot(along) / length_squared, 0.0, 1.0) : 0;
      least = std::min(least, (a + t * along - point).norm());
    }
  }
  return least;
}

// It need not be the foremost sensor: of three with a slanted front edge both front ones are
// loaded.
TEST_P(SensorLayout, PutsTheCenterNearestToAPointBeyondTheSensors) {
  const std::vector<Vector2d>& positions = GetParam();
  FootLoad load(positions);
  constexpr int kNumDirections = 72;
  // All layouts are within 0.08 m of the frame's origin.
  constexpr double kBeyond = 0.2;
  for (int i = 0; i < kNumDirections; ++i) {
    const double angle = i * 2 * M_PI / kNumDirections;
    const Vector2d point = kBeyond * Vector2d(std::cos(angle), std::sin(angle));
    const std::vector<double> fractions = load.distribute(point);
    expect_valid(fractions);
    EXPECT_NEAR((center_of(positions, fractions) - point).norm(),
                distance_to_hull(positions, point), 1e-9)
        << "angle " << angle;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Counts, SensorLayout,
    testing::Values(std::vector<Vector2d>{{0.01, 0.02}},
                    std::vector<Vector2d>{{0.07, 0}, {-0.03, 0.01}},
                    std::vector<Vector2d>{{0.07, 0.03}, {0.06, -0.02}, {-0.03, 0}},
                    // Four, but not front left, front right, rear left, rear right.
                    std::vector<Vector2d>{{0.07, 0}, {0.02, 0.03}, {0.02, -0.03}, {-0.03, 0}},
                    std::vector<Vector2d>{
                        {0.07, 0.03}, {0.07, -0.02}, {0.02, 0.03}, {-0.03, 0.03}, {-0.03, -0.02}},
                    std::vector<Vector2d>{{0.07, 0.03},
                                          {0.07, -0.02},
                                          {0.02, 0.03},
                                          {0.02, -0.03},
                                          {-0.03, 0.03},
                                          {-0.03, -0.02}}),
    [](const auto& info) {
      return std::to_string(info.param.size()) + "Number" + std::to_string(info.index);
    });

TEST(FootLoad, OfAFootWithoutSensorsIsEmpty) {
  EXPECT_TRUE(FootLoad({}).distribute({0, 0}).empty());
}

TEST(FootLoad, OfAFootWithThreeSensorsIsMeasured) {
  World world{SceneFile{}};
  RobotOptions options;
  options.posture = "Start";
  options.ideal_sensors = true;
  const int robot = world.add_robot(make_biped_with_three_sensors(), options);
  for (int i = 0; i < 300; ++i) world.step_tick();
  const Eigen::VectorXd& force = world.sensors(robot).foot_force;
  ASSERT_EQ(force.size(), 4);
  const double weight = world.robot(robot).tree().total_mass() * kGravity;
  EXPECT_NEAR(force.sum(), weight, 1e-3 * weight);
  // Three on the left foot, one on the right, which each carry half.
  EXPECT_NEAR(force.head<3>().sum(), weight / 2, 0.01 * weight);
}

}  // namespace
}  // namespace nao::sim
