#include <gtest/gtest.h>

#include "common/constants.h"
#include "test/daemons/motion/physics_trial.h"

namespace nao::trial {
namespace {

TEST(OrientationFault, StopsTheWalkWithItsReasonAndAllowsItAgainAfterwards) {
  ClosedLoop trial(trial_options(), 5);
  trial.run(0.5);
  const int64_t walk = trial.hold_walk({0.15, 0, 0});
  trial.run(3);
  EXPECT_EQ(trial.core().motion_state().mode, Mode::kWalking);
  // Pitch by the robot is wrong by 8 degrees from now on.
  trial.on_sensors([](motion::Sensors& sensors) {
    sensors.orientation_torso_in_world = sensors.orientation_torso_in_world *
                                         Eigen::AngleAxisd(8 * kDegree, Eigen::Vector3d::UnitY());
  });
  const auto end = trial.await_end(walk, 4);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kFailed);
  EXPECT_EQ(end->reason.code, "orientation-doubtful");
  trial.release_walk(false);
  trial.run(2);
  EXPECT_LT(trial.torso_tilt(), 0.2);
  EXPECT_EQ(trial.core().motion_state().mode, Mode::kHolding);
  const auto refused = trial.await_end(trial.send({"", 0, WalkCommand{0.1, 0, 0}}), 1);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, ResultStatus::kRefused);
  EXPECT_EQ(refused->reason.code, "orientation-doubtful");
  trial.on_sensors({});
  trial.run(1.5);
  trial.hold_walk({0.15, 0, 0});
  trial.run(2);
  EXPECT_EQ(trial.core().motion_state().mode, Mode::kWalking);
}

TEST(OrientationFault, IsNotFoundInAFallAndAGetUp) {
  ClosedLoop trial(trial_options(), 5);
  double greatest = 0;
  trial.on_tick([&] { greatest = std::max(greatest, trial.estimate().orientation_doubt); });
  trial.run(0.5);
  trial.world().push(0, 0, {0, 5, 0});
  trial.run(12);
  EXPECT_LT(trial.torso_tilt(), 0.3);
  EXPECT_EQ(greatest, 0);
}

}  // namespace
}  // namespace nao::trial
