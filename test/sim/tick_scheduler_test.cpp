#include "sim/tick_scheduler.h"

#include <gtest/gtest.h>

namespace nao::sim {
namespace {

constexpr double kPeriod = 0.01;

TEST(TickScheduler, RunsATickEveryPeriodOfTheWallClock) {
  TickScheduler scheduler(1, kPeriod, false, 1);
  double now = 0;
  for (int64_t tick = 0; tick < 100; ++tick) {
    ASSERT_TRUE(scheduler.may_run(tick));
    now = scheduler.next_time(tick, now);
    EXPECT_EQ(scheduler.begin_tick(tick, now), 0);
  }
  EXPECT_NEAR(now, 1, 1e-9);
  EXPECT_EQ(scheduler.num_late_ticks(), 0);
}

TEST(TickScheduler, CountsTicksThatBeginMoreThanTwoMillisecondsLate) {
  TickScheduler scheduler(1, kPeriod, false, 1);
  EXPECT_NEAR(scheduler.begin_tick(0, 0.0115), 0.0015, 1e-12);
  EXPECT_EQ(scheduler.num_late_ticks(), 0);
  EXPECT_NEAR(scheduler.begin_tick(1, 0.023), 0.003, 1e-12);
  EXPECT_EQ(scheduler.num_late_ticks(), 1);
}

TEST(TickScheduler, RunsSingleStepsWhilePaused) {
  TickScheduler scheduler(1, kPeriod, false, 0);
  scheduler.pause();
  EXPECT_FALSE(scheduler.may_run(0));
  EXPECT_TRUE(scheduler.is_stopped());
  scheduler.step(2, 0);
  EXPECT_FALSE(scheduler.is_stopped());
  ASSERT_TRUE(scheduler.may_run(0));
  scheduler.begin_tick(0, 0);
  ASSERT_TRUE(scheduler.may_run(1));
  scheduler.begin_tick(1, 0);
  EXPECT_FALSE(scheduler.may_run(2));
  scheduler.resume(0);
  EXPECT_TRUE(scheduler.may_run(2));
}

TEST(TickScheduler, WaitsInLockStepForAllRobots) {
  TickScheduler scheduler(2, kPeriod, true, 1);
  EXPECT_EQ(scheduler.pace(), 0);
  EXPECT_FALSE(scheduler.may_run(0));
  EXPECT_EQ(scheduler.awaited_robot(0), 0);
  scheduler.note_command(0, 0, 0);
  EXPECT_EQ(scheduler.awaited_robot(0), 1);
  EXPECT_FALSE(scheduler.may_run(0));
  scheduler.note_command(1, 0, 0);
  EXPECT_TRUE(scheduler.may_run(0));
  scheduler.begin_tick(0, 0);
  EXPECT_FALSE(scheduler.may_run(1));
  // An old answer does not count.
  scheduler.note_command(0, 1, 0);
  scheduler.note_command(1, 0, 0);
  EXPECT_FALSE(scheduler.may_run(1));
}

/** Runs ticks that a controller answers after a delay, s, as far as they are not waited for.
 * @return When the next tick is run, after the controller has stopped answering. */
double next_time_after_silence(double answer_delay) {
  TickScheduler scheduler(1, kPeriod, false, 1);
  double now = 0;
  int64_t tick = 0;
  for (; tick < 50; ++tick) {
    now = scheduler.next_time(tick, now);
    scheduler.begin_tick(tick, now);
    scheduler.note_command(0, tick + 1, now + answer_delay);
  }
  now = scheduler.next_time(tick, now);
  scheduler.begin_tick(tick, now);
  return scheduler.next_time(tick + 1, now) - now;
}

TEST(TickScheduler, WaitsThreePeriodsForANearbyControllerAndNotForADistantOne) {
  EXPECT_NEAR(next_time_after_silence(0.002), 3 * kPeriod, 1e-9);
  EXPECT_NEAR(next_time_after_silence(0.03), kPeriod, 1e-9);
}

TEST(TickScheduler, ReadsCommandsWhenATickIsDueAndAsTheyArriveWhereOneWaitsForThem) {
  TickScheduler scheduler(1, kPeriod, false, 1);
  scheduler.begin_tick(0, 0.01);
  EXPECT_NEAR(scheduler.next_reading(1, 0.011).value_or(0), 0.02, 1e-12);
  EXPECT_EQ(scheduler.next_reading(1, 0.02), std::nullopt) << "the tick is due";
  EXPECT_EQ(scheduler.next_reading(64, 0.011), std::nullopt) << "the latency is measured";
  scheduler.rest(1, TickScheduler::kRestTicks);
  EXPECT_EQ(scheduler.next_reading(1, 0.011), std::nullopt) << "a command ends the rest";
  scheduler.drop_batch();
  scheduler.pause();
  EXPECT_EQ(scheduler.next_reading(1, 0.011), std::nullopt);
  scheduler.resume(0.011);
  EXPECT_NE(scheduler.next_reading(1, 0.012), std::nullopt);
  scheduler.set_pace(0.1, 0.011);
  EXPECT_EQ(scheduler.next_reading(1, 0.012), std::nullopt) << "the tick is not due for long";
  scheduler.set_pace(0, 0.011);
  EXPECT_EQ(scheduler.next_reading(1, 0.012), std::nullopt);
  EXPECT_EQ(TickScheduler(1, kPeriod, true, 1).next_reading(1, 0), std::nullopt) << "lock-step";
}

TEST(TickScheduler, CountsMissingCommandsOfAnActiveController) {
  TickScheduler scheduler(1, kPeriod, false, 1);
  scheduler.begin_tick(0, 0.01);
  EXPECT_EQ(scheduler.num_late_commands(), 0) << "there is no controller";
  scheduler.note_command(0, 1, 0.011);
  scheduler.begin_tick(1, 0.02);
  EXPECT_EQ(scheduler.num_late_commands(), 0);
  scheduler.begin_tick(2, 0.03);
  EXPECT_EQ(scheduler.num_late_commands(), 1);
  scheduler.begin_tick(3, 1);
  EXPECT_EQ(scheduler.num_late_commands(), 1) << "it has been silent for long";
}

TEST(TickScheduler, ForgetsAnswersInAReset) {
  TickScheduler scheduler(1, kPeriod, true, 1);
  scheduler.note_command(0, 5, 0);
  scheduler.reset(0);
  EXPECT_FALSE(scheduler.may_run(0));
  scheduler.note_command(0, 0, 0);
  EXPECT_TRUE(scheduler.may_run(0));
}

}  // namespace
}  // namespace nao::sim
