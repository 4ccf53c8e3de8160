// Changes of head and arms during a walk.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "test/daemons/motion/physics_trial.h"

namespace nao::trial {
namespace {

class OverlayTest : public testing::Test {
 protected:
  void walk() {
    trial_.run(1);
    walk_ = trial_.hold_walk({0.15, 0, 0});
    trial_.run(2);
    ASSERT_EQ(trial_.core().motion_state().mode, Mode::kWalking);
  }
  int64_t turn(std::vector<std::string> names, std::vector<double> angles, double speed = 0.5) {
    return trial_.send(
        {"", 0, JointChangeCommand{std::move(names), std::move(angles), false, speed, false}});
  }
  double angle(const char* name) {
    return trial_.world().robot(0).motor_position()[trial_.model().find_motor(name)];
  }
  /** Final results of a command so far. */
  std::vector<CommandResult> ends(int64_t id) {
    std::vector<CommandResult> ends;
    for (const CommandResult& result : trial_.results()) {
      if (result.id == id && result.status != ResultStatus::kAccepted) ends.push_back(result);
    }
    return ends;
  }

  ClosedLoop trial_{trial_options(), 3};
  int64_t walk_ = 0;
};

TEST_F(OverlayTest, HeadAndArmTurnDuringAWalk) {
  walk();
  const double start = trial_.torso_in_world().translation().x();
  const auto end = trial_.await_end(turn({"HeadYaw", "LShoulderPitch"}, {0.8, 0.6}), 3);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
  trial_.run(2);
  // The joints keep their angles although the walk would swing the arms.
  EXPECT_EQ(trial_.core().motion_state().mode, Mode::kWalking);
  EXPECT_TRUE(ends(walk_).empty());
  EXPECT_NEAR(angle("HeadYaw"), 0.8, 0.03);
  EXPECT_NEAR(angle("LShoulderPitch"), 0.6, 0.05);
  EXPECT_GT(trial_.torso_in_world().translation().x() - start, 0.2);
  EXPECT_LT(trial_.torso_tilt(), 0.3);
}

TEST_F(OverlayTest, ANewerChangeInterruptsTheOlderOnce) {
  walk();
  const int64_t slow = turn({"HeadYaw"}, {1.5}, 0.05);
  trial_.run(0.5);
  const int64_t quick = turn({"HeadYaw"}, {-0.5});
  trial_.run(3);
  ASSERT_EQ(ends(slow).size(), 1u);
  EXPECT_EQ(ends(slow)[0].status, ResultStatus::kInterrupted);
  ASSERT_EQ(ends(quick).size(), 1u);
  EXPECT_EQ(ends(quick)[0].status, ResultStatus::kDone);
  EXPECT_NEAR(angle("HeadYaw"), -0.5, 0.03);
}

TEST_F(OverlayTest, RefusesAnArmThatWouldHitTheBodyAndContinuesToWalk) {
  walk();
  const int64_t id = turn({"LShoulderPitch", "LShoulderRoll", "LElbowYaw", "LElbowRoll"},
                          {1.4, -0.31, -1.0, -1.5});
  trial_.run(0.5);
  ASSERT_EQ(ends(id).size(), 1u);
  EXPECT_EQ(ends(id)[0].status, ResultStatus::kRefused);
  EXPECT_EQ(ends(id)[0].reason.code, "self-collision");
  EXPECT_EQ(trial_.core().motion_state().mode, Mode::kWalking);
}

TEST_F(OverlayTest, AFallEndsTheChangeWithOneResult) {
  walk();
  const int64_t id = turn({"HeadYaw"}, {1.5}, 0.03);
  trial_.run(0.2);
  trial_.world().push(0, 0, {0, 8, 0});
  trial_.run(3);
  ASSERT_EQ(ends(id).size(), 1u);
  EXPECT_EQ(ends(id)[0].status, ResultStatus::kFailed) << ends(id)[0].reason;
}

}  // namespace
}  // namespace nao::trial
