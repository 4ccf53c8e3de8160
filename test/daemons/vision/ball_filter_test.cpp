#include "daemons/vision/ball_filter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/random.h"

namespace nao::vision {
namespace {

constexpr int64_t kPeriod = 66667;
const Eigen::Matrix2d kCovariance = Eigen::Matrix2d::Identity() * 0.02 * 0.02;

TEST(BallFilter, KnowsNothingAtFirst) {
  BallFilter filter;
  filter.predict(1000000);
  EXPECT_FALSE(filter.estimate().is_known);
}

TEST(BallFilter, EstimatesTheVelocityOfARollingBall) {
  BallFilter filter;
  Random random(3);
  double x = 0;
  double v = 1.2;
  for (int i = 0; i < 20; ++i) {
    filter.predict(kPeriod * (i + 1));
    filter.update({x + 0.02 * random.normal(), 0.5 + 0.02 * random.normal()}, kCovariance);
    const double dt = 1e-6 * kPeriod;
    x += v * dt - 0.15 * dt * dt;
    v -= 0.3 * dt;
  }
  EXPECT_TRUE(filter.estimate().is_rolling);
  EXPECT_NEAR(filter.estimate().state[2], v, 0.15);
  EXPECT_NEAR(filter.estimate().state[3], 0, 0.15);
}

TEST(BallFilter, KnowsTheVelocityOfAKickedBallAfterFourImages) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    BallFilter filter;
    Random random(seed);
    const double dt = 1e-6 * kPeriod;
    for (int i = 0; i < 64; ++i) {
      const double rolled = 1.4 * dt * std::max(0, i - 59);
      filter.predict(kPeriod * (i + 1));
      filter.update({1.5 - rolled + 0.02 * random.normal(), 0.02 * random.normal()}, kCovariance);
    }
    EXPECT_TRUE(filter.estimate().is_rolling) << seed;
    EXPECT_NEAR(filter.estimate().state[2], -1.4, 0.5) << seed;
  }
}

TEST(BallFilter, BallAtRestDoesNotRoll) {
  BallFilter filter;
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    filter.predict(kPeriod * (i + 1));
    filter.update({1 + 0.02 * random.normal(), 0.02 * random.normal()}, kCovariance);
    EXPECT_FALSE(filter.estimate().is_rolling) << i;
  }
}

TEST(BallFilter, IgnoresOneWrongBallAndFollowsAMovedOne) {
  BallFilter filter;
  int64_t utime = 0;
  const auto see = [&](double x) {
    filter.predict(utime += kPeriod);
    filter.update({x, 0}, kCovariance);
  };
  for (int i = 0; i < 20; ++i) see(1);
  see(4);
  EXPECT_NEAR(filter.estimate().state[0], 1, 0.05);
  see(1);
  for (int i = 0; i < 3; ++i) see(3);
  EXPECT_NEAR(filter.estimate().state[0], 3, 0.05);
}

TEST(BallFilter, ForgetsABallThatIsNotSeen) {
  BallFilter filter;
  filter.predict(kPeriod);
  filter.update({1, 0}, kCovariance);
  filter.predict(kPeriod + 4000000);
  EXPECT_TRUE(filter.estimate().is_known);
  filter.predict(kPeriod + 6000000);
  EXPECT_FALSE(filter.estimate().is_known);
}

}  // namespace
}  // namespace nao::vision
