#include "phone-gateway/server/core/stream_throttle.h"

#include <gtest/gtest.h>

#include <random>

namespace nao::gateway {
namespace {

/** Events passed in `time` s of a stream of `rate` events a second, each up to `jitter` s late. */
int count(double requested, double rate, double jitter, double time, double phase = 0) {
  StreamThrottle throttle(requested, phase);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> late(0, jitter);
  int num_passed = 0;
  const int num_events = static_cast<int>(rate * time);
  for (int i = 0; i < num_events; ++i) num_passed += throttle.allow(50 + i / rate + late(random));
  return num_passed;
}

TEST(StreamThrottle, Passes60Of100Events) {
  EXPECT_NEAR(count(60, 100, 0, 10), 600, 2);
  EXPECT_NEAR(count(60, 100, 0.003, 10), 600, 2);
}

TEST(StreamThrottle, PassesAllEventsOfAStreamOfItsRateInSpiteOfJitter) {
  EXPECT_GE(count(15, 15, 0.02, 20), 298);
  EXPECT_GE(count(30, 30, 0.01, 20), 598);
}

TEST(StreamThrottle, PassesAllEventsOfASlowerStream) {
  EXPECT_EQ(count(60, 20, 0.005, 10), 200);
}

TEST(StreamThrottle, DoesNotCatchUpAfterAPause) {
  StreamThrottle throttle(10);
  EXPECT_TRUE(throttle.allow(100));
  EXPECT_TRUE(throttle.allow(200));
  int num_passed = 0;
  for (int i = 1; i <= 50; ++i) num_passed += throttle.allow(200 + i * 0.002);
  EXPECT_LE(num_passed, 2);
}

TEST(StreamThrottle, PassesAllEventsOfAStreamOfItsRateAtAnyPhase) {
  for (const double phase : {0.0, 0.3, 0.6, 0.9}) EXPECT_GE(count(30, 30, 0.01, 20, phase), 598);
}

TEST(StreamThrottle, PassesTheSameEventsAtTheSamePhaseWhenItBeganLater) {
  StreamThrottle early(30, 0.3);
  StreamThrottle late(30, 0.3);
  int num_different = 0;
  for (int i = 0; i < 1000; ++i) {
    const double now = 50 + i * 0.01;
    const bool is_early = early.allow(now);
    if (i >= 7) num_different += static_cast<int>(late.allow(now) != is_early);
  }
  EXPECT_LE(num_different, 1) << "the first one";
}

TEST(StreamThrottle, PassesOtherEventsAtAnotherPhaseAlsoAfterAPause) {
  StreamThrottle early(10);
  StreamThrottle late(10, 0.5);
  const auto num_common = [&](double start) {
    int num_both = 0;
    for (int i = 0; i < 1000; ++i) {
      const bool is_early = early.allow(start + i * 0.01);
      num_both += static_cast<int>(late.allow(start + i * 0.01) && is_early);
    }
    return num_both;
  };
  EXPECT_LE(num_common(50), 2)
      << "the first one, which passes at once at every phase, and the one after it";
  EXPECT_LE(num_common(100), 2);
}

TEST(StreamThrottle, PassesNothingAtRateZero) {
  StreamThrottle throttle(0);
  EXPECT_FALSE(throttle.allow(1));
}

}  // namespace
}  // namespace nao::gateway
