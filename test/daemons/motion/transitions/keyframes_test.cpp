#include "daemons/motion/transitions/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class KeyframePlayerTest : public ::testing::Test {
 protected:
  Keyframe keyframe(double duration, double head_yaw) const {
    Keyframe frame;
    frame.duration = duration;
    frame.position.assign(nao_model().num_motors(), kNan);
    frame.stiffness.assign(nao_model().num_motors(), kNan);
    frame.position[head_] = head_yaw;
    return frame;
  }
  KeyframePlayer play(std::vector<Keyframe> keyframes, double speed = 1) const {
    return {nao_model(), {"test", "", "", std::move(keyframes)}, start_, speed};
  }
  double head_at(const KeyframePlayer& player, double time) const {
    std::vector<double> position = start_;
    std::vector<double> stiffness(start_.size(), 1.0);
    player.sample(time, position, stiffness);
    return position[head_];
  }

  const int head_ = nao_motor("HeadYaw");
  const std::vector<double> start_ = nao_posture("StandInit");
};

TEST_F(KeyframePlayerTest, ReachesEachKeyframeInTime) {
  const KeyframePlayer player = play({keyframe(1, 0.5), keyframe(2, -0.5)});
  EXPECT_DOUBLE_EQ(player.duration(), 3);
  EXPECT_NEAR(head_at(player, 0), start_[head_], 1e-12);
  EXPECT_NEAR(head_at(player, 1), 0.5, 1e-12);
  EXPECT_NEAR(head_at(player, 3), -0.5, 1e-12);
  EXPECT_NEAR(head_at(player, 9), -0.5, 1e-12);
}

TEST_F(KeyframePlayerTest, NeverOvershootsAKeyframe) {
  const KeyframePlayer player =
      play({keyframe(0.5, 0.1), keyframe(1, 1.0), keyframe(0.3, 1.05), keyframe(1, 0.2)});
  double last = head_at(player, 0);
  for (double time = 0.001; time <= 1.8; time += 0.001) {
    const double angle = head_at(player, time);
    EXPECT_GE(angle, last - 1e-12) << time;
    EXPECT_LE(angle, 1.05 + 1e-12) << time;
    last = angle;
  }
}

TEST_F(KeyframePlayerTest, PassesAKeyframeInTheSameDirectionWithoutAStop) {
  const double through = head_at(play({keyframe(1, 0.5), keyframe(1, 1.0)}), 1.01) - 0.5;
  Keyframe pausing = keyframe(1, 0.5);
  pausing.pause = 0.1;
  const double after_pause = head_at(play({pausing, keyframe(1, 1.0)}), 1.11) - 0.5;
  EXPECT_NEAR(through / 0.01, 0.5, 0.05);
  EXPECT_NEAR(after_pause / 0.01, 0, 0.05);
}

TEST_F(KeyframePlayerTest, SpeedScalesDurationsAndNotPauses) {
  Keyframe first = keyframe(1, 0.5);
  first.pause = 0.4;
  const KeyframePlayer player = play({first, keyframe(1, 0)}, 0.5);
  EXPECT_DOUBLE_EQ(player.end_of(0), 2.4);
  EXPECT_DOUBLE_EQ(player.duration(), 4.4);
  EXPECT_DOUBLE_EQ(player.last_arrival(), 4.4);
  EXPECT_EQ(player.stage_at(2.3), 0);
  EXPECT_EQ(player.stage_at(2.5), 1);
}

TEST_F(KeyframePlayerTest, TakesLongerWhereAMotorWouldBeTooSlow) {
  const double distance = 2;
  const KeyframePlayer player = play({keyframe(0.01, start_[head_] + distance)});
  EXPECT_NEAR(player.duration(), 1.15 * distance / nao_model().motor_joint(head_).max_velocity,
              1e-9);
  const KeyframePlayer fastest(
      nao_model(), {"", "", "", {keyframe(0.01, start_[head_] + distance)}}, start_, 1.0, 1.0);
  EXPECT_NEAR(fastest.duration(), distance / nao_model().motor_joint(head_).max_velocity, 1e-9);
}

TEST_F(KeyframePlayerTest, SetsStiffnessOnlyWhereAKeyframeDoes) {
  Keyframe soft = keyframe(1, 0.5);
  soft.stiffness[head_] = 0.3;
  std::vector<double> position = start_;
  std::vector<double> stiffness(start_.size(), 0.8);
  play({soft}).sample(0.5, position, stiffness);
  EXPECT_DOUBLE_EQ(stiffness[head_], 0.3);
  EXPECT_DOUBLE_EQ(stiffness[head_ + 1], 0.8);
}

TEST(Mirrored, ExchangesSidesAndSigns) {
  std::vector<double> position = nao_posture("StandZero");
  position[nao_motor("HeadYaw")] = 0.3;
  position[nao_motor("LShoulderPitch")] = 0.4;
  position[nao_motor("LShoulderRoll")] = 0.5;
  const std::vector<double> other = mirrored(nao_model(), position);
  EXPECT_DOUBLE_EQ(other[nao_motor("HeadYaw")], -0.3);
  EXPECT_DOUBLE_EQ(other[nao_motor("RShoulderPitch")], 0.4);
  EXPECT_DOUBLE_EQ(other[nao_motor("RShoulderRoll")], -0.5);
  EXPECT_EQ(mirrored(nao_model(), other), position);
}

TEST(Mirrored, ExchangesTheSidesOfTheDirectionOfUp) {
  Keyframe frame;
  frame.position = nao_posture("StandZero");
  frame.stiffness.assign(nao_model().num_motors(), 1.0);
  frame.up[1] = {0.2, 0.9};
  const KeyframeSequence other = mirrored(nao_model(), KeyframeSequence{"a", "", "", {frame}});
  EXPECT_DOUBLE_EQ(other.keyframes[0].up[1].least, -0.9);
  EXPECT_DOUBLE_EQ(other.keyframes[0].up[1].greatest, -0.2);
}

}  // namespace
}  // namespace nao::motion
