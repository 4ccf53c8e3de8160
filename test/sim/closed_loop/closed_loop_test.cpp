#include "sim/closed_loop/closed_loop.h"

#include <gtest/gtest.h>

#include "common/data_path.h"
#include "common/error.h"

namespace nao {
namespace {

ClosedLoopOptions options_with_tick(int tick_ms) {
  ClosedLoopOptions options;
  options.model =
      std::make_shared<const RobotModel>(RobotModel::load(data_path() / "robots" / "nao"));
  options.is_ideal = true;
  options.tick_ms = tick_ms;
  return options;
}

class ControlPeriod : public testing::TestWithParam<int> {};

TEST_P(ControlPeriod, HoldsAWalkByTime) {
  ClosedLoop loop(options_with_tick(GetParam()), 1);
  EXPECT_EQ(loop.period(), 1e-3 * GetParam());
  loop.run(1.2);
  EXPECT_NEAR(loop.time(), 1.2, loop.period());
  // A walk command is valid for 0.5 s: the walk continues only if it is repeated in time.
  const double start = loop.torso_in_world().translation().x();
  loop.hold_walk({0.1, 0, 0});
  loop.run(4.8);
  EXPECT_NEAR(loop.time(), 6, 2 * loop.period());
  EXPECT_GT(loop.torso_in_world().translation().x() - start, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, ControlPeriod, testing::Values(10, 12),
                         [](const auto& info) { return std::to_string(info.param); });

TEST(ClosedLoop, KeepsAResultOfARepeatedWalkOnce) {
  ClosedLoop loop(options_with_tick(10), 1);
  loop.run(1);
  const int64_t walk = loop.hold_walk({0.1, 0, 0});
  // The core answers each of 50 commands.
  loop.run(10);
  ASSERT_EQ(loop.results().size(), 1u);
  EXPECT_EQ(loop.results()[0].id, walk);
  EXPECT_EQ(loop.results()[0].status, ResultStatus::kAccepted);
  loop.release_walk();
  ASSERT_TRUE(loop.await_end(walk, 10));
  EXPECT_LE(loop.results().size(), 2u);
  // Another walk has results of its own.
  const int64_t next = loop.hold_walk({0.1, 0, 0});
  loop.run(1);
  EXPECT_EQ(loop.results().back().id, next);
  EXPECT_EQ(loop.take_results().back().id, next);
  EXPECT_TRUE(loop.results().empty());
}

TEST(ClosedLoop, DelaysCommandsAlsoWithoutDisturbances) {
  ClosedLoopOptions late_options = options_with_tick(10);
  late_options.command_latency_ticks = 5;
  ClosedLoop loop(options_with_tick(10), 1);
  ClosedLoop late(late_options, 1);
  for (ClosedLoop* each : {&loop, &late}) {
    each->hold_walk({0.1, 0, 0});
    each->run(2);
  }
  EXPECT_NE(loop.torso_in_world().translation(), late.torso_in_world().translation());
}

TEST(ClosedLoop, RejectsAControlPeriodBetweenPhysicsSteps) {
  EXPECT_THROW(ClosedLoop(options_with_tick(11), 1), ConfigError);
  EXPECT_THROW(ClosedLoop(options_with_tick(-2), 1), ConfigError);
}

TEST(ClosedLoop, DrawsTheSameNumbersForASeed) {
  ClosedLoop loop(options_with_tick(10), 7);
  ClosedLoop same(options_with_tick(10), 7);
  const double number = loop.random(2, 3);
  EXPECT_EQ(number, same.random(2, 3));
  EXPECT_GE(number, 2);
  EXPECT_LT(number, 3);
}

}  // namespace
}  // namespace nao
