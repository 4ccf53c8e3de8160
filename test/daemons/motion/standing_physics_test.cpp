// A standing robot is pushed.

#include <gtest/gtest.h>

#include <cmath>

#include "test/daemons/motion/physics_trial.h"
#include "test/daemons/motion/policy_robot.h"
#include "tools/nao-trial/lying_start.h"

namespace nao::trial {
namespace {

/** Whether a robot stands 2.5 s after a push, N s. */
bool stands_after(double impulse, double direction, uint64_t seed,
                  const ClosedLoopOptions& options = trial_options()) {
  ClosedLoop trial(options, seed);
  trial.run(0.5);
  trial.world().push(0, 0, {impulse * std::cos(direction), impulse * std::sin(direction), 0});
  trial.run(2.5);
  return trial.torso_tilt() < 0.3 && trial.core().motion_state().mode == Mode::kHolding;
}

// The servos alone withstand 1.98 N s.
TEST(StandingPhysics, WithstandsAPushAheadAndBack) {
  for (uint64_t seed = 41; seed <= 44; ++seed) {
    EXPECT_TRUE(stands_after(2.07, 0, seed)) << seed;
    EXPECT_TRUE(stands_after(2.07, M_PI, seed)) << seed;
    EXPECT_TRUE(stands_after(2.5, M_PI / 2, seed)) << seed;
  }
}

// Without a step a T1 withstands 0.33 N s for each kg ahead or back.
TEST(StandingPhysics, AnswersAPushByStepsAndStandsAgain) {
  // No policy catches it.
  const motion::PolicyRobot robot;
  ClosedLoopOptions options = trial_options();
  options.model = robot.load();
  const double impulse = 0.45 * options.model->total_mass();
  for (uint64_t seed = 41; seed <= 43; ++seed) {
    EXPECT_TRUE(stands_after(impulse, 0, seed, options)) << seed;
    EXPECT_TRUE(stands_after(impulse, M_PI, seed, options)) << seed;
  }
}

// Of its own push recovery a T1 withstands most of the first pushes.
TEST(StandingPhysics, ARobotIsKnockedOverWhateverItWithstands) {
  ClosedLoopOptions options = trial_options();
  options.model = std::make_shared<const RobotModel>(
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "t1"));
  for (uint64_t seed = 41; seed <= 44; ++seed) {
    ClosedLoop trial(options, seed);
    trial.run(1);
    EXPECT_TRUE(knock_over(trial, 0)) << seed;
  }
}

}  // namespace
}  // namespace nao::trial
