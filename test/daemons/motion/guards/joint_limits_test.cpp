#include "daemons/motion/guards/joint_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

class TargetLimiterTest : public ::testing::Test {
 protected:
  double max_step(int motor, double dt) const {
    return nao_model().motor_joint(motor).max_velocity * dt;
  }

  const int head_ = nao_motor("HeadYaw");
  const std::vector<double> last_ = nao_posture("StandInit");
  std::vector<double> target_ = last_;
  TargetLimiter limiter_{nao_model()};
};

TEST_F(TargetLimiterTest, LeavesTargetsWithinReachAsTheyAre) {
  target_[head_] += 0.5 * max_step(head_, 0.01);
  const std::vector<double> expected = target_;
  limiter_.limit(last_, 0.01, target_);
  EXPECT_EQ(target_, expected);
}

TEST_F(TargetLimiterTest, LimitsTheSpeedForAnyPeriod) {
  for (const double dt : {0.008, 0.01, 0.012}) {
    target_ = last_;
    target_[head_] += 1;
    limiter_.limit(last_, dt, target_);
    EXPECT_NEAR(target_[head_] - last_[head_], max_step(head_, dt), 1e-12) << dt;
  }
}

TEST_F(TargetLimiterTest, LimitsTheAngle) {
  target_[head_] = 9;
  limiter_.limit(last_, 100, target_);
  EXPECT_DOUBLE_EQ(target_[head_], nao_model().motor_joint(head_).upper);
}

TEST_F(TargetLimiterTest, ReplacesWhatIsNotFiniteByTheLastTarget) {
  target_[head_] = std::nan("");
  target_[head_ + 1] = std::numeric_limits<double>::infinity();
  limiter_.limit(last_, 0.01, target_);
  EXPECT_EQ(target_, last_);
}

TEST_F(TargetLimiterTest, KeepsCoupledLimitsAtFullSpeed) {
  // The range of HeadPitch shrinks while HeadYaw turns outwards.
  const int pitch = nao_motor("HeadPitch");
  std::vector<double> last = last_;
  last[pitch] = nao_model().clip_to_limits(pitch, 9, last);
  for (int i = 0; i < 300; ++i) {
    std::vector<double> target = last;
    target[head_] = 2;
    limiter_.limit(last, 0.01, target);
    ASSERT_LE(std::abs(target[pitch] - last[pitch]), max_step(pitch, 0.01) * (1 + 1e-9));
    ASSERT_NEAR(nao_model().clip_to_limits(pitch, target[pitch], target), target[pitch], 1e-9);
    last = target;
  }
  EXPECT_NEAR(last[head_], 2, 1e-9);
}

TEST(ClipToLimits, ClipsSingleAndCoupledLimits) {
  std::vector<double> position = nao_posture("StandInit");
  position[nao_motor("HeadYaw")] = 1.526988;
  position[nao_motor("HeadPitch")] = 5;
  position[nao_motor("LKneePitch")] = -9;
  clip_to_limits(nao_model(), position);
  EXPECT_NEAR(position[nao_motor("HeadPitch")], 0.200015, 1e-6);
  EXPECT_DOUBLE_EQ(position[nao_motor("LKneePitch")],
                   nao_model().motor_joint(nao_motor("LKneePitch")).lower);
}

}  // namespace
}  // namespace nao::motion
