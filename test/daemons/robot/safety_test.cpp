#include "daemons/robot/safety.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "daemons/robot/robot_core.h"
#include "test/daemons/robot/lola_nao.h"

namespace nao::robot {
namespace {

/** A robot whose servos follow their targets at once, on the core. */
class SafeRobot : public testing::Test {
 protected:
  explicit SafeRobot(bool starts_itself = false)
      : core_(std::in_place, nao_model(), nao_map(), starts_itself) {
    command_.position = nao_model().find_posture("Stand")->position;
    command_.stiffness.assign(command_.position.size(), 1);
  }

  /** Frames of 12 ms. @return The phase at the end. */
  Phase run(double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.012); ++i) frame();
    return core_->safety().phase();
  }
  void frame() {
    core_->take_frame(frame_, 1);
    const LolaCommand& answer =
        core_->step({has_controller_ ? &command_ : nullptr, false, is_ending_});
    frame_.position = *answer.position;
    frame_.stiffness = *answer.stiffness;
  }
  void press(double seconds) {
    frame_.touch[0] = 1;
    run(seconds);
    frame_.touch[0] = 0;
  }
  /** Brings the robot to kDriven. */
  void drive() {
    press(0.1);
    run(0.6);
    ASSERT_EQ(run(2.5), Phase::kDriven);
    run(1);
  }
  float leg_stiffness() const { return frame_.stiffness[10]; }
  bool is_limp() const {
    // Hips of a seated robot keep a little.
    return *std::max_element(frame_.stiffness.begin(), frame_.stiffness.end()) <= 0.15f;
  }
  bool is_seated() const {
    const std::vector<double>& rest =
        nao_model().find_posture(nao_model().references().rest)->position;
    for (size_t i = 0; i < rest.size(); ++i) {
      if (std::abs(core_->targets().position[i] - rest[i]) > 0.01) return false;
    }
    return true;
  }

  LolaState frame_ = frame_of("Stand", 0);
  std::optional<RobotCore> core_;
  Targets command_;
  bool has_controller_ = true;
  bool is_ending_ = false;
};

class SelfStartingRobot : public SafeRobot {
 protected:
  SelfStartingRobot() : SafeRobot(true) {}
};

TEST_F(SafeRobot, StartsLimpWithTargetsAtTheMeasuredAngles) {
  frame_.position[0] = 0.5f;
  EXPECT_EQ(run(5), Phase::kLimp);
  EXPECT_EQ(leg_stiffness(), 0);
  EXPECT_EQ(frame_.position[0], 0.5f);
  // It is moved by hand.
  frame_.position[0] = 0.52f;
  frame();
  EXPECT_EQ(frame_.position[0], 0.52f);
}

TEST_F(SafeRobot, OnePressMakesItStiffSlowlyFromTheMeasuredAngles) {
  frame_.position[10] = 0.3f;
  press(0.1);
  run(0.6);
  EXPECT_EQ(core_->safety().phase(), Phase::kStiffening);
  EXPECT_LT(leg_stiffness(), 0.1f);
  run(1.1);
  EXPECT_NEAR(leg_stiffness(), 0.5, 0.15);
  EXPECT_NEAR(frame_.position[10], 0.3f, 1e-6);
  EXPECT_EQ(run(1.3), Phase::kDriven);
  run(1);
  EXPECT_EQ(leg_stiffness(), 1);
  EXPECT_EQ(core_->targets().position, command_.position);
}

TEST_F(SafeRobot, GetsStiffOnlyUprightWithAControllerAndWithoutFault) {
  frame_.angles = {0, 0.3f};
  press(0.1);
  EXPECT_EQ(run(3), Phase::kLimp);
  frame_.angles = {-0.3f, 0};
  press(0.1);
  EXPECT_EQ(run(3), Phase::kLimp);
  frame_.angles = {0, 0};
  has_controller_ = false;
  press(0.1);
  EXPECT_EQ(run(3), Phase::kLimp);
  has_controller_ = true;
  frame_.battery[0] = 0.05f;
  press(0.1);
  EXPECT_EQ(run(3), Phase::kLimp);
  frame_.battery[0] = 0.9f;
  press(0.1);
  EXPECT_EQ(run(4), Phase::kDriven);
}

TEST_F(SafeRobot, TwoPressesMakeAStiffRobotLimpAtOnce) {
  drive();
  press(0.1);
  run(0.2);
  press(0.1);
  EXPECT_EQ(run(0.6), Phase::kLimp);
  EXPECT_TRUE(is_limp());
  EXPECT_EQ(core_->safety().cause(), Cause::kButton);
}

TEST_F(SafeRobot, ALongPressMakesItSitDownAndEnd) {
  drive();
  press(3.1);
  EXPECT_EQ(core_->safety().phase(), Phase::kSitting);
  EXPECT_EQ(run(3.1), Phase::kEnded);
  EXPECT_TRUE(is_seated());
  EXPECT_TRUE(is_limp());
}

TEST_F(SafeRobot, TheButtonIsIgnoredWhileItLies) {
  drive();
  frame_.angles = {0, 1.5f};
  press(3.1);
  run(1);
  EXPECT_EQ(core_->safety().phase(), Phase::kDriven);
}

TEST_F(SafeRobot, SitsDownAfterTenFramesWithoutACommand) {
  drive();
  has_controller_ = false;
  run(9 * 0.012);
  EXPECT_EQ(core_->safety().phase(), Phase::kDriven);
  frame();
  EXPECT_EQ(core_->safety().phase(), Phase::kSitting);
  EXPECT_EQ(core_->safety().cause(), Cause::kLinkLost);
  EXPECT_GE(leg_stiffness(), 0.75f);
  EXPECT_EQ(run(3.1), Phase::kLimp);
  EXPECT_TRUE(is_seated());
  EXPECT_TRUE(is_limp());
  EXPECT_NEAR(frame_.stiffness[9], 0.12, 1e-6) << "the hips keep it from tipping backwards";
}

TEST_F(SafeRobot, SitsDownAtEveryFault) {
  const std::vector<std::pair<Cause, std::function<void()>>> faults{
      {Cause::kBatteryLow, [this] { frame_.battery[0] = 0.05f; }},
      {Cause::kHeat, [this] { frame_.status[10] = 2; }},
      {Cause::kEnding, [this] { is_ending_ = true; }}};
  for (const auto& [cause, break_it] : faults) {
    frame_ = frame_of("Stand", 0);
    core_.emplace(nao_model(), nao_map(), false);
    is_ending_ = false;
    drive();
    break_it();
    run(1);
    EXPECT_EQ(core_->safety().phase(), Phase::kSitting) << to_string(cause);
    EXPECT_EQ(core_->safety().cause(), cause);
    EXPECT_EQ(run(3), cause == Cause::kEnding ? Phase::kEnded : Phase::kLimp);
    EXPECT_TRUE(is_seated() && is_limp());
  }
}

TEST_F(SafeRobot, BeyondTheTiltLimitItIsLimpInTheSameFrame) {
  drive();
  frame_.angles = {0.6f, 0};
  run(1);
  EXPECT_EQ(core_->safety().phase(), Phase::kDriven) << "falls are the controller's matter";
  is_ending_ = true;
  frame();
  EXPECT_EQ(leg_stiffness(), 0);
  frame();
  EXPECT_EQ(core_->safety().phase(), Phase::kEnded);
}

TEST_F(SafeRobot, EndsWhenTheServosAreLimpAndNotWhenTheyWereTold) {
  drive();
  frame_.angles = {0.6f, 0};
  is_ending_ = true;
  const LolaState stiff = frame_;
  // The robot loses four frames: the command is sent again in each.
  for (int i = 0; i < 4; ++i) {
    frame();
    EXPECT_EQ(core_->safety().phase(), Phase::kLimp);
    EXPECT_EQ(leg_stiffness(), 0);
    frame_.stiffness = stiff.stiffness;
  }
  frame();
  frame();
  EXPECT_EQ(core_->safety().phase(), Phase::kEnded);
}

TEST_F(SafeRobot, EndsAfterAWhileWithServosThatDoNotBecomeLimp) {
  drive();
  frame_.angles = {0.6f, 0};
  is_ending_ = true;
  const LolaState stiff = frame_;
  int num_frames = 0;
  while (core_->safety().phase() != Phase::kEnded && num_frames < 100) {
    frame();
    frame_.stiffness = stiff.stiffness;
    ++num_frames;
  }
  EXPECT_NEAR(num_frames * 0.012, 0.3, 0.03);
}

TEST_F(SafeRobot, GoesLimpWhenItTipsOverWhileItSitsDown) {
  drive();
  has_controller_ = false;
  run(1);
  ASSERT_EQ(core_->safety().phase(), Phase::kSitting);
  frame_.angles = {0, -0.6f};
  frame();
  EXPECT_EQ(core_->safety().phase(), Phase::kLimp);
  EXPECT_EQ(leg_stiffness(), 0);
}

TEST_F(SafeRobot, ARelaxedRobotStaysLimpWhenItEnds) {
  drive();
  command_.stiffness.assign(command_.stiffness.size(), 0);
  run(0.1);
  is_ending_ = true;
  frame();
  frame();
  EXPECT_EQ(core_->safety().phase(), Phase::kEnded);
}

TEST_F(SafeRobot, FoundStiffItSitsDownFirst) {
  frame_ = frame_of("Stand", 1);
  has_controller_ = false;
  frame();
  EXPECT_EQ(core_->safety().phase(), Phase::kSitting);
  EXPECT_EQ(run(3.1), Phase::kLimp);
  EXPECT_TRUE(is_seated() && is_limp());
}

TEST_F(SafeRobot, FoundSeatedItsHipsGoOnHolding) {
  frame_ = frame_of("Crouch", 0);
  frame_.stiffness[9] = frame_.stiffness[14] = 0.12f;
  EXPECT_EQ(run(1), Phase::kLimp);
  EXPECT_NEAR(frame_.stiffness[9], 0.12, 1e-6);
  EXPECT_EQ(leg_stiffness(), 0);
}

TEST_F(SafeRobot, TheFirstDrivenFrameDoesNotFollowTheCommandForALimpRobot) {
  press(0.1);
  command_.stiffness.assign(command_.stiffness.size(), 0);
  while (core_->safety().phase() != Phase::kDriven) frame();
  EXPECT_NEAR(leg_stiffness(), 1, 1e-3);
  core_->take_frame(frame_, 1);
  EXPECT_EQ(core_->tick(), 0);
}

TEST_F(SafeRobot, FoundStiffAndLyingItIsLimpInTheSameFrame) {
  frame_ = frame_of("Stand", 1);
  frame_.angles = {0, 1.5f};
  frame();
  EXPECT_EQ(core_->safety().phase(), Phase::kLimp);
  EXPECT_EQ(leg_stiffness(), 0);
}

TEST_F(SafeRobot, TicksBeginAnewWhenCommandsBeginAndCeaseToBeFollowed) {
  run(0.5);
  EXPECT_GT(core_->tick(), 30);
  EXPECT_EQ(core_->commanded_stiffness(10), 0);
  drive();
  EXPECT_LT(core_->tick(), 120);
  EXPECT_EQ(core_->commanded_stiffness(10), 1);
  has_controller_ = false;
  run(0.2);
  EXPECT_LT(core_->tick(), 10);
  EXPECT_EQ(core_->commanded_stiffness(10), 0) << "though the servos are stiff while it sits down";
}

TEST_F(SelfStartingRobot, StartsWheneverItMay) {
  has_controller_ = false;
  EXPECT_EQ(run(1), Phase::kLimp);
  has_controller_ = true;
  EXPECT_EQ(run(3), Phase::kDriven);
  has_controller_ = false;
  EXPECT_EQ(run(4), Phase::kLimp);
  has_controller_ = true;
  EXPECT_EQ(run(3), Phase::kDriven);
}

}  // namespace
}  // namespace nao::robot
