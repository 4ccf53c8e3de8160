// nao-motion is killed at any time and restarted: the servos hold, and a new core takes over.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "test/daemons/motion/physics_trial.h"
#include "tools/nao-trial/lying_start.h"

namespace nao::trial {
namespace {

constexpr double kTick = 0.01;  // s

/** Kills and restarts the core; no target may jump until a second after the restart. */
void kill_and_restart(ClosedLoop& trial, double dead_time) {
  std::vector<double> last = trial.targets();
  int num_jumps = 0;
  std::string worst;
  trial.on_tick([&] {
    for (int motor = 0; motor < trial.model().num_motors(); ++motor) {
      const Joint& joint = trial.model().motor_joint(motor);
      const double change = std::abs(trial.targets()[motor] - last[motor]);
      if (change <= joint.max_velocity * kTick * (1 + 1e-9)) continue;
      ++num_jumps;
      worst = joint.name + " by " + std::to_string(change) + " rad";
    }
    last = trial.targets();
  });
  trial.set_core_crashed(true);
  trial.run(dead_time);
  trial.restart_core();
  trial.set_core_crashed(false);
  trial.run(1);
  trial.on_tick({});
  EXPECT_EQ(num_jumps, 0) << worst;
}

bool is_settled(ClosedLoop& trial) {
  return trial.core().motion_state().mode == Mode::kHolding &&
         !trial.core().motion_state().posture.empty();
}

TEST(Takeover, AStandingRobotKeepsStanding) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    ClosedLoop trial(trial_options(), seed);
    trial.run(1 + trial.random(0, 0.5));
    kill_and_restart(trial, 0.5);
    EXPECT_LT(trial.torso_tilt(), 0.2);
    EXPECT_TRUE(trial.run_until([&] { return is_settled(trial); }, 5));
  }
}

TEST(Takeover, AtAnyTimeOfAPostureChange) {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    ClosedLoop trial(trial_options(), seed);
    trial.run(1);
    trial.send_posture(seed % 2 == 0 ? "SitRelax" : "LyingBelly", 0.5);
    trial.run(0.5 + 0.6 * static_cast<double>(seed));
    kill_and_restart(trial, 0.3);
    EXPECT_TRUE(trial.run_until([&] { return is_settled(trial); }, 60)) << seed;
  }
}

TEST(Takeover, AtAnyTimeOfAWalk) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    ClosedLoop trial(trial_options(), seed);
    trial.run(1);
    trial.hold_walk({0.15, 0, 0});
    trial.run(3 + 0.11 * static_cast<double>(seed));
    trial.release_walk(false);
    kill_and_restart(trial, 0.3);
    EXPECT_TRUE(trial.run_until([&] { return is_settled(trial); }, 60)) << seed;
  }
}

TEST(Takeover, DuringAFallAndGettingUp) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    ClosedLoop trial(trial_options(), seed);
    trial.run(1);
    ASSERT_TRUE(knock_over(trial, static_cast<double>(seed)));
    // From the middle of the fall to the middle of getting up; a robot that has its feet below it
    // again keeps the posture in which it is found.
    trial.run(0.6 * static_cast<double>(seed - 1));
    kill_and_restart(trial, 0.3);
    EXPECT_TRUE(trial.run_until([&] { return has_got_up(trial); }, 60))
        << seed << ": torso at " << trial.torso_height() << " m, tilted by " << trial.torso_tilt()
        << " rad, posture " << trial.core().motion_state().posture << ", "
        << trial.core().motion_state().num_tries << " tries";
  }
}

TEST(Takeover, ARelaxedRobotStaysRelaxed) {
  ClosedLoop trial(trial_options(), 1);
  trial.run(1);
  ASSERT_TRUE(trial.await_end(trial.send_action("rest"), 20));
  kill_and_restart(trial, 0.5);
  EXPECT_EQ(trial.core().motion_state().mode, Mode::kRelaxed);
  EXPECT_EQ(trial.core().motion_state().stiffness, 0);
}

}  // namespace
}  // namespace nao::trial
