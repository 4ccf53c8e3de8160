#include "daemons/motion/walk/step_timing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "daemons/motion/walk/weight_transfer.h"
#include "daemons/motion/walk/zmp_control.h"
#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

constexpr double kTimingOmega = 6.1;  // 1/s
constexpr double kTime = 0.1;         // s

class StepTimingTest : public testing::Test {
 protected:
  StepTimingTest() { gait_.feedback.timing_gain = 1; }

  /** DCM that reaches its end point when a step of this duration ends. */
  static LateralDcm dcm_for(double duration) {
    return {0.1 * std::exp(-kTimingOmega * (duration - kTime)), 0.1};
  }
  double adapt(const LateralDcm& dcm, double time = kTime) const {
    return adapt_step_duration(gait_, dcm, kTimingOmega, time, gait_.timing.step_duration);
  }

  Gait gait_ = nao_gait();
};

TEST_F(StepTimingTest, KeepsTheNominalDurationOfAStepThatGoesAsPlanned) {
  EXPECT_NEAR(adapt(dcm_for(gait_.timing.step_duration)), gait_.timing.step_duration, 1e-12);
}

TEST_F(StepTimingTest, EndsTheStepWhenTheDcmReachesItsEndPoint) {
  for (const double duration : {0.21, 0.25, 0.3, 0.35}) {
    EXPECT_NEAR(adapt(dcm_for(duration)), duration, 1e-12);
  }
}

TEST_F(StepTimingTest, AppliesAFractionOfTheChange) {
  gait_.feedback.timing_gain = 0.5;
  const double nominal = gait_.timing.step_duration;
  EXPECT_NEAR(adapt(dcm_for(nominal + 0.02)), nominal + 0.01, 1e-12);
  gait_.feedback.timing_gain = 0;
  EXPECT_EQ(adapt(dcm_for(nominal + 0.02)), nominal);
}

TEST_F(StepTimingTest, StaysWithinTheShortestAndTheLongestStep) {
  EXPECT_EQ(adapt(dcm_for(5)), gait_.timing.max_step_duration);
  EXPECT_EQ(adapt(dcm_for(0.11)), gait_.timing.min_step_duration);
  // Beyond the end point, and back over the support foot.
  EXPECT_EQ(adapt({0.12, 0.1}), gait_.timing.min_step_duration);
  EXPECT_EQ(adapt({-0.01, 0.1}), gait_.timing.max_step_duration);
}

TEST_F(StepTimingTest, LeavesTheFootTimeToLand) {
  const double late = gait_.timing.step_duration - kMinHorizon + 0.001;
  EXPECT_EQ(adapt(dcm_for(5), late), gait_.timing.step_duration);
  const double time = gait_.timing.step_duration - kMinHorizon - 0.001;
  EXPECT_GE(adapt({0.12, 0.1}, time), time + kMinHorizon);
}

TEST_F(StepTimingTest, SwingsBetweenTheDoubleSupports) {
  gait_.timing.double_support_duration = 0.04;
  gait_.swing.arrival_fraction = 0.9;
  EXPECT_FALSE(time_swing(gait_, 0.019, 0.24).is_swinging);
  const SwingTiming start = time_swing(gait_, 0.02, 0.24);
  EXPECT_TRUE(start.is_swinging);
  EXPECT_NEAR(start.phase, 0, 1e-12);
  EXPECT_NEAR(start.remaining, 0.9 * 0.2, 1e-12);
  EXPECT_NEAR(time_swing(gait_, 0.22, 0.24).phase, 1, 1e-12);
  EXPECT_NEAR(time_swing(gait_, 0.02 + 0.9 * 0.2, 0.24).remaining, 0, 1e-12);
}

TEST(WeightTransfer, UnloadsTheFootAtLiftoffAndLoadsItAtTouchdown) {
  constexpr double kDuration = 0.24;
  constexpr double kTransfer = 0.04;
  EXPECT_DOUBLE_EQ(swing_load_ratio(0, kDuration, kTransfer), 0.5);
  EXPECT_NEAR(swing_load_ratio(0.01, kDuration, kTransfer), 0.25, 1e-12);
  for (const double time : {0.02, 0.1, 0.22}) {
    EXPECT_NEAR(swing_load_ratio(time, kDuration, kTransfer), 0, 1e-12) << time;
  }
  EXPECT_NEAR(swing_load_ratio(0.23, kDuration, kTransfer), 0.25, 1e-12);
  // A late touchdown: half of the weight, until the foot is the support foot.
  EXPECT_DOUBLE_EQ(swing_load_ratio(0.3, kDuration, kTransfer), 0.5);
}

TEST(WeightTransfer, HappensAtOnceWithoutDoubleSupport) {
  EXPECT_EQ(swing_load_ratio(0, 0.24, 0), 0);
  EXPECT_EQ(swing_load_ratio(0.24, 0.24, 0), 0);
}

TEST(WeightTransfer, FollowsTheLeverRuleInDoubleSupport) {
  const Eigen::Vector2d support(0.01, -0.05);
  const Eigen::Vector2d other(0.03, 0.05);
  EXPECT_DOUBLE_EQ(load_ratio_at_zmp(support, support, other), 0);
  EXPECT_DOUBLE_EQ(load_ratio_at_zmp(other, support, other), 1);
  EXPECT_NEAR(load_ratio_at_zmp(0.7 * support + 0.3 * other, support, other), 0.3, 1e-12);
  // Forces and lever arms balance.
  const double ratio = load_ratio_at_zmp({0.02, 0.01}, support, other);
  EXPECT_GT(ratio, 0.5);
  EXPECT_EQ(load_ratio_at_zmp({0, 0.4}, support, other), 1);
}

}  // namespace
}  // namespace nao::motion
