#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "test/daemons/motion/physics_trial.h"
#include "tools/nao-trial/lying_start.h"

namespace nao::trial {
namespace {

/** Runs until a lying robot stands, and goes on standing, or its first try has failed. */
bool gets_up_at_the_first_try(ClosedLoop& trial) {
  const auto num_tries = [&] { return trial.core().motion_state().num_tries; };
  return trial.run_until([&] { return has_got_up(trial) || num_tries() > 1; }, 30) &&
         num_tries() <= 1 && keeps_standing(trial);
}

TEST(GetUp, FromEverySideOnWhichItCanLie) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    ClosedLoop trial(trial_options(), static_cast<uint64_t>(quarter));
    trial.run(0.5);
    lay_down(trial, quarter * M_PI / 2);
    const LyingStill lying = wait_until_still(trial);
    EXPECT_TRUE(trial.run_until([&] { return has_got_up(trial); }, 30)) << lying.side;
  }
}

TEST(GetUp, OfAUsedRobotMostlyAtTheFirstTry) {
  ClosedLoopOptions options = trial_options();
  options.disturbances = std::make_shared<const sim::DisturbanceSet>(sim::DisturbanceSet::load(
      std::filesystem::path(NAO_TEST_DATA) / "disturbances" / "real.yaml"));
  int num_first = 0;
  constexpr int kNumTrials = 30;
  for (uint64_t seed = 0; seed < kNumTrials; ++seed) {
    ClosedLoop trial(options, seed);
    trial.run(0.5);
    lay_down(trial, trial.random(-M_PI, M_PI));
    num_first += gets_up_at_the_first_try(trial) ? 1 : 0;
  }
  EXPECT_GE(num_first, 23);
}

TEST(GetUp, AfterAFallAheadAtTheFirstTry) {
  for (const char* robot : {"nao", "t1", "k1"}) {
    ClosedLoopOptions options = trial_options();
    options.model = std::make_shared<const RobotModel>(
        RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / robot));
    int num_first = 0;
    constexpr int kNumTrials = 10;
    for (uint64_t seed = 0; seed < kNumTrials; ++seed) {
      ClosedLoop trial(options, seed);
      trial.run(1.5);
      ASSERT_TRUE(knock_over(trial, trial.random(-0.3, 0.3)));
      num_first += gets_up_at_the_first_try(trial) ? 1 : 0;
    }
    EXPECT_GE(num_first, 9) << robot;
  }
}

TEST(GetUp, WithoutTheOptionTheRobotLiesUntilACommand) {
  ClosedLoopOptions options = trial_options();
  options.motion.gets_up = false;
  ClosedLoop trial(options, 1);
  trial.run(1);
  ASSERT_TRUE(knock_over(trial, 0.3));
  trial.run(6);
  EXPECT_GT(trial.torso_tilt(), 1.0);
  EXPECT_EQ(trial.core().motion_state().mode, Mode::kFallen);
  EXPECT_EQ(trial.core().motion_state().num_tries, 0);
  // A walk does not get it up either.
  const auto refused = trial.await_end(trial.hold_walk({0.1, 0, 0}), 1);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, ResultStatus::kRefused);
  trial.release_walk(false);
  const auto end = trial.await_end(trial.send_action("get-up"), 60);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
  EXPECT_TRUE(has_got_up(trial));
}

TEST(GetUp, AWalkFromASeatStandsUpFirst) {
  for (const char* seat : {"Sit", "SitRelax"}) {
    ClosedLoop trial(trial_options(), 2);
    trial.run(1);
    ASSERT_TRUE(trial.await_end(trial.send_posture(seat, 0.5), 60));
    const int64_t id = trial.hold_walk({0, 0, 0.5});
    const bool walks =
        trial.run_until([&] { return trial.core().motion_state().mode == Mode::kWalking; }, 40);
    EXPECT_TRUE(walks) << seat << ": " << trial.results().back().reason;
    trial.run(3);
    trial.release_walk();
    const auto end = trial.await_end(id, 5);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
    EXPECT_LT(trial.torso_tilt(), 0.3);
  }
}

}  // namespace
}  // namespace nao::trial
