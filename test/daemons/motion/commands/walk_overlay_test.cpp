#include "daemons/motion/commands/walk_overlay.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/robot_at_rest.h"

namespace nao::motion {
namespace {

class WalkOverlayTest : public ::testing::Test {
 protected:
  void start_head_turn(double angle) {
    overlay_.start({"test", 1, JointChangeCommand{{"HeadYaw"}, {angle}, false, 1, false}},
                   robot_.context(), robot_.targets());
  }
  /** Steps until the change is done. */
  std::optional<Reason> run() {
    for (int i = 0; i < 300; ++i) {
      if (auto remark = overlay_.step(robot_.context(0.01), robot_.targets())) return remark;
    }
    return std::nullopt;
  }

  const int head_ = nao_motor("HeadYaw");
  RobotAtRest robot_;
  WalkOverlay overlay_;
};

TEST_F(WalkOverlayTest, HoldsTheAngleAfterTheChangeUntilTheWalkEnds) {
  start_head_turn(0.4);
  EXPECT_EQ(run(), Reason());
  overlay_.stop();
  EXPECT_EQ(overlay_.command(), nullptr);
  JointTargets walk = robot_.targets();
  walk.position[head_] = -0.1;
  overlay_.write(walk);
  EXPECT_DOUBLE_EQ(walk.position[head_], 0.4);
  overlay_.release();
  walk.position[head_] = -0.1;
  overlay_.write(walk);
  EXPECT_DOUBLE_EQ(walk.position[head_], -0.1);
}

TEST_F(WalkOverlayTest, WritesOnlyTheJointsOfTheChange) {
  start_head_turn(0.4);
  run();
  JointTargets walk = robot_.targets();
  walk.position.assign(nao_model().num_motors(), 0.05);
  JointTargets written = walk;
  overlay_.write(written);
  for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
    EXPECT_EQ(written.position[motor] != walk.position[motor], motor == head_);
  }
}

TEST_F(WalkOverlayTest, ANewerChangeDoesNotEndTheStiffnessRampOfAnOlderOne) {
  JointChangeCommand limp{{"LShoulderPitch"}, {0}, true, 1, false};
  limp.joint_stiffness = {0};
  overlay_.start({"test", 1, limp}, robot_.context(), robot_.targets());
  for (int i = 0; i < 10; ++i) {
    overlay_.step(robot_.context(0.01), robot_.targets());
    overlay_.write(robot_.targets());
  }
  start_head_turn(0.01);
  for (int i = 0; i < 45; ++i) {
    overlay_.step(robot_.context(0.01), robot_.targets());
    overlay_.write(robot_.targets());
  }
  EXPECT_EQ(robot_.targets().stiffness[nao_motor("LShoulderPitch")], 0);
  EXPECT_EQ(robot_.targets().stiffness[head_], 1);
}

TEST_F(WalkOverlayTest, RemarksThatAChangeWasClipped) {
  start_head_turn(9);
  EXPECT_EQ(run(), Reason("clipped-to-limits", {"HeadYaw"}));
}

}  // namespace
}  // namespace nao::motion
