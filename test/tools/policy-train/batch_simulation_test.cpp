#include "tools/policy-train/batch_simulation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "test/tools/policy-train/small_policy.h"

namespace nao::policy_train {
namespace {

EnvironmentOptions disturbed_options() {
  EnvironmentOptions options = options_of(kLegs);
  options.disturbances =
      std::make_shared<sim::DisturbanceSet>(sim::DisturbanceSet::find("moderate"));
  options.push = 0.3;
  return options;
}

/** The arrays after some steps with waving legs. */
BatchRows run(int num_threads, uint64_t seed, int num_steps) {
  const EnvironmentOptions options = disturbed_options();
  BatchSimulation batch(options, 5, num_threads, seed);
  BatchRows rows(*options.manifest, batch.size());
  batch.reset(rows.arrays());
  for (int k = 0; k < num_steps; ++k) {
    for (size_t i = 0; i < rows.actions.size(); ++i) {
      rows.actions[i] = static_cast<float>(std::sin(0.3 * k + static_cast<double>(i)));
    }
    batch.step(rows.arrays());
  }
  return rows;
}

TEST(BatchSimulation, GivesTheSameWithAnyNumberOfThreads) {
  const BatchRows one = run(1, 7, 100);
  const BatchRows three = run(3, 7, 100);
  EXPECT_EQ(one.observations, three.observations);
  EXPECT_EQ(one.privileged, three.privileged);
  EXPECT_EQ(one.terms, three.terms);
  EXPECT_EQ(one.terminated, three.terminated);
  EXPECT_NE(one.observations, run(1, 100, 100).observations);
}

TEST(BatchSimulation, StandsAtTheDefaultAngles) {
  EnvironmentOptions options = options_of(kLegs);
  options.command = Eigen::Vector3d::Zero();
  options.episode_time = 5;
  BatchSimulation batch(options, 1, 1, 1);
  BatchRows rows(*options.manifest, 1);
  batch.reset(rows.arrays());
  for (int k = 0; k < 249; ++k) {
    batch.step(rows.arrays());
    ASSERT_EQ(rows.terminated[0] + rows.truncated[0], 0) << k;
  }
  // Upright, at rest, on both feet.
  EXPECT_NEAR(rows.observations[5], -1, 0.01);
  EXPECT_NEAR(rows.privileged[0], 0, 0.02);
  EXPECT_NEAR(rows.privileged[7] + rows.privileged[8], 1, 0.05);
  EXPECT_GT(rows.terms[static_cast<size_t>(RewardTerm::kVelocityTracking)], 0.98F);
  batch.step(rows.arrays());
  EXPECT_EQ(rows.truncated[0], 1);
  EXPECT_EQ(rows.terminated[0], 0);
}

TEST(BatchSimulation, EndsAnEpisodeWithAFallAndBeginsTheNext) {
  EnvironmentOptions options = options_of(kLegs);
  BatchSimulation batch(options, 1, 1, 1);
  BatchRows rows(*options.manifest, 1);
  batch.reset(rows.arrays());
  // Ankles bent: the robot tips over.
  rows.actions[3] = rows.actions[7] = 3;
  int k = 0;
  while (k < 250 && rows.terminated[0] == 0) {
    batch.step(rows.arrays());
    ++k;
  }
  ASSERT_EQ(rows.terminated[0], 1);
  EXPECT_GT(k, 10);
  EXPECT_EQ(rows.terms[static_cast<size_t>(RewardTerm::kFallen)], 1);
  // The observation is the next episode's first: upright. That of the end: tipped over.
  EXPECT_NEAR(rows.observations[5], -1, 0.01);
  EXPECT_NEAR(rows.privileged[6], 0, 0.02);
  EXPECT_GT(rows.final_observations[5], -0.83F);
}

// As when a policy catches a robot: its ready posture's angles, and moving.
TEST(BatchSimulation, BeginsManyEpisodesOfRobotsThatArePushedWithAPush) {
  EnvironmentOptions options = options_of(kLegs);
  options.push = 0.3;
  options.start_spread = 0;
  constexpr int kNumRobots = 40;
  BatchSimulation batch(options, kNumRobots, 1, 1);
  BatchRows rows(*options.manifest, kNumRobots);
  batch.reset(rows.arrays());
  const double ready = options.model->ready_posture()
                           .position[static_cast<size_t>(options.manifest->joints[0].motor)];
  int num_pushed = 0;
  for (size_t i = 0; i < kNumRobots; ++i) {
    const float* robot = &rows.observations[i * rows.observations.size() / kNumRobots];
    const bool is_pushed = std::abs(rows.privileged[i * kNumPrivileged]) > 0.02F ||
                           std::abs(rows.privileged[i * kNumPrivileged + 1]) > 0.02F;
    EXPECT_NEAR(robot[9], is_pushed ? ready + 0.3 : 0, 0.07) << i;
    num_pushed += is_pushed ? 1 : 0;
  }
  EXPECT_GT(num_pushed, kNumRobots / 4);
  EXPECT_LT(num_pushed, kNumRobots * 3 / 4);
}

TEST(BatchSimulation, HasTheRobotsOfASeed) {
  const EnvironmentOptions options = disturbed_options();
  BatchSimulation batch(options, 2, 1, 1);
  BatchSimulation other(options, 2, 1, 9);
  BatchRows rows(*options.manifest, 2), other_rows(*options.manifest, 2);
  batch.reset(rows.arrays());
  other.reset(other_rows.arrays());
  EXPECT_NE(rows.observations, other_rows.observations);
  batch.seed(9);
  batch.reset(rows.arrays());
  EXPECT_EQ(rows.observations, other_rows.observations);
}

TEST(BatchSimulation, ChangesTheCommandedVelocityAsWhereThePolicyRuns) {
  EnvironmentOptions options = options_of(kLegs);
  options.command_time = 0.5;
  BatchSimulation batch(options, 1, 1, 3);
  BatchRows rows(*options.manifest, 1);
  batch.reset(rows.arrays());
  const auto command = [&] { return Eigen::Map<const Eigen::Vector3f>(&rows.observations[6]); };
  EXPECT_TRUE(command().isZero(0));
  double greatest = 0;
  for (int k = 0; k < 100; ++k) {
    const Eigen::Vector3f before = command();
    batch.step(rows.arrays());
    if (rows.terminated[0] != 0) continue;
    const Eigen::Vector3f change = command() - before;
    EXPECT_LT(std::abs(change.x()), 1.01F * 0.02F) << k;
    EXPECT_LT(std::abs(change.z()), 2.01F * 0.02F) << k;
    greatest = std::max(greatest, std::abs(static_cast<double>(command().x())));
  }
  EXPECT_GT(greatest, 0.1);
}

EnvironmentOptions get_up_options() {
  return options_of(replaced(replaced(kLegs, "kind: walk", "kind: get-up"),
                             "command: {vx: [-0.2, 0.8], vy: [-0.1, 0.1], wz: [-0.4, 0.4]}",
                             "duration: 8"));
}

TEST(BatchSimulation, LaysHalfOfTheRobotsDownThatAreToGetUp) {
  const EnvironmentOptions options = get_up_options();
  constexpr int kSize = 32;
  BatchSimulation batch(options, kSize, 1, 1);
  BatchRows rows(*options.manifest, kSize);
  batch.reset(rows.arrays());
  const size_t count = rows.observations.size() / kSize;
  int num_on_belly = 0, num_on_back = 0, num_upright = 0;
  for (size_t i = 0; i < kSize; ++i) {
    num_on_belly += rows.observations[count * i + 3] > 0.8F ? 1 : 0;
    num_on_back += rows.observations[count * i + 3] < -0.8F ? 1 : 0;
    num_upright += rows.observations[count * i + 5] < -0.7F ? 1 : 0;
  }
  EXPECT_GT(num_on_belly, 3);
  EXPECT_GT(num_on_back, 3);
  EXPECT_GT(num_upright, 3);
}

// Its own legs do not lift it: without the pull the torso stays on the floor.
TEST(BatchSimulation, PullsTheTorsoOfARobotThatIsToGetUpUntilItStands) {
  EnvironmentOptions options = get_up_options();
  options.episode_time = 4;
  BatchSimulation batch(options, 4, 1, 1);
  BatchRows rows(*options.manifest, 4);
  batch.reset(rows.arrays());
  const auto assist = [&](size_t i) {
    return rows.terms[kNumRewardTerms * i + static_cast<size_t>(RewardTerm::kAssist)];
  };
  batch.step(rows.arrays());
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(assist(i), 0.6F, 1e-6F);
  AssistSchedule schedule(0.6);
  for (int k = 0; k < 19; ++k) schedule.learn(true);
  EXPECT_NEAR(schedule.share(), 0.03, 1e-9);
  schedule.learn(false);
  EXPECT_NEAR(schedule.share(), 0.045, 1e-9);
  for (int k = 0; k < 2; ++k) schedule.learn(true);
  EXPECT_EQ(schedule.share(), 0);
}

TEST(BatchSimulation, TakesAnActionThatIsNotFiniteForZero) {
  const EnvironmentOptions options = options_of(kLegs);
  BatchSimulation batch(options, 1, 1, 1);
  BatchRows rows(*options.manifest, 1);
  batch.reset(rows.arrays());
  std::fill(rows.actions.begin(), rows.actions.end(), std::numeric_limits<float>::quiet_NaN());
  for (int k = 0; k < 50; ++k) batch.step(rows.arrays());
  EXPECT_EQ(rows.terminated[0], 0);
  EXPECT_TRUE(std::all_of(rows.observations.begin(), rows.observations.end(),
                          [](float value) { return std::isfinite(value); }));
}

}  // namespace
}  // namespace nao::policy_train
