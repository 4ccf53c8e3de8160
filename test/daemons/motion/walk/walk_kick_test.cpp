#include "daemons/motion/walk/walk_kick.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using State = WalkKick::State;

const Vector3d kCommanded(0.2, 0, 0);

class WalkKickTest : public testing::Test {
 protected:
  const Gait& gait_ = nao_gait();
  WalkKick kick_{gait_};
};

TEST_F(WalkKickTest, WithoutABallTheNextSwingOfTheFootKicks) {
  kick_.request(true, std::nullopt);
  // On the left foot the right one swings.
  EXPECT_EQ(kick_.begin_step(kCommanded, true, {}), kCommanded);
  EXPECT_FALSE(kick_.is_striking());
  kick_.end_step();
  EXPECT_EQ(kick_.begin_step(kCommanded, false, {}), kCommanded);
  EXPECT_TRUE(kick_.is_striking());
  EXPECT_EQ(kick_.state(), State::kPending);
  kick_.end_step();
  EXPECT_FALSE(kick_.is_striking());
  EXPECT_EQ(kick_.state(), State::kStruck);
}

TEST_F(WalkKickTest, TheStepsLeadToTheBall) {
  const Vector2d ball(0.7, 0.1);
  kick_.request(false, ball);
  EXPECT_TRUE(kick_.seeks_ball());
  Pose2 body;
  bool support_is_left = false;
  for (int i = 0; i < 40 && !kick_.is_striking(); ++i) {
    const Vector3d velocity = kick_.begin_step(kCommanded, support_is_left, body);
    if (kick_.is_striking()) break;
    EXPECT_EQ(velocity.z(), 0);
    body = body * Pose2{velocity.head<2>() * gait_.timing.step_duration, 0};
    kick_.end_step();
    support_is_left = !support_is_left;
  }
  ASSERT_TRUE(kick_.is_striking());
  EXPECT_TRUE(support_is_left);
  // The ball lies ahead of the right foot, as far from its sole as kicks best.
  const Vector2d ball_in_body = body.inverse() * ball;
  EXPECT_NEAR(ball_in_body.x() + gait_.stance.turn_center, gait_.kick.ball_distance, 0.026);
  EXPECT_NEAR(ball_in_body.y(), -gait_.stance.foot_separation / 2, 0.021);
}

TEST_F(WalkKickTest, GivesUpABallThatIsNotReachedInTime) {
  kick_.request(true, Vector2d(3, 0));
  kick_.advance(9.9);
  kick_.begin_step(kCommanded, true, {});
  EXPECT_EQ(kick_.state(), State::kPending);
  kick_.advance(0.2);
  EXPECT_EQ(kick_.begin_step(kCommanded, true, {}), kCommanded);
  EXPECT_EQ(kick_.state(), State::kMissed);
}

TEST_F(WalkKickTest, SwingsOutAndBackWithinTheStep) {
  EXPECT_EQ(kick_.swing_offset(0.5).lift, 0);
  kick_.request(true, std::nullopt);
  kick_.begin_step(kCommanded, false, {});
  EXPECT_NEAR(kick_.swing_offset(0.5).reach.x(), gait_.kick.swing_reach, 1e-12);
  EXPECT_NEAR(kick_.swing_offset(0.5).lift, gait_.kick.swing_lift, 1e-12);
  for (const double end : {0.0, 1.0}) {
    EXPECT_NEAR(kick_.swing_offset(end).reach.norm(), 0, 1e-12);
    EXPECT_NEAR(kick_.swing_offset(end).lift, 0, 1e-12);
  }
}

TEST_F(WalkKickTest, SwingsTowardsABallOffItsBestPlace) {
  const Vector2d best(gait_.kick.ball_distance - gait_.stance.turn_center,
                      gait_.stance.foot_separation / 2);
  kick_.request(true, Vector2d(best + Vector2d(-0.02, 0.015)));
  kick_.begin_step(kCommanded, false, {});
  ASSERT_TRUE(kick_.is_striking());
  const Vector2d reach = kick_.swing_offset(0.5).reach;
  EXPECT_NEAR(reach.x(), gait_.kick.swing_reach - 0.02, 1e-12);
  EXPECT_NEAR(reach.y(), 0.015, 1e-12);
}

}  // namespace
}  // namespace nao::motion
