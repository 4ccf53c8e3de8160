#include "phone-gateway/server/pacer.h"

#include <gtest/gtest.h>

#include <random>

namespace nao {
namespace {

/** Events let through in `time` seconds of a stream of `rate` a second, each up to `jitter` late.
 */
int count(double wished, double rate, double jitter, double time, double phase = 0) {
  Pacer pacer(wished, phase);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> late(0, jitter);
  int num_passed = 0;
  const int num_events = static_cast<int>(rate * time);
  for (int i = 0; i < num_events; ++i) num_passed += pacer.allow(50 + i / rate + late(random));
  return num_passed;
}

TEST(Pacer, ThinsTo60Of100) {
  EXPECT_NEAR(count(60, 100, 0, 10), 600, 2);
  EXPECT_NEAR(count(60, 100, 0.003, 10), 600, 2);
}

TEST(Pacer, PassesAStreamOfItsOwnRateWholeInSpiteOfJitter) {
  EXPECT_GE(count(15, 15, 0.02, 20), 298);
  EXPECT_GE(count(30, 30, 0.01, 20), 598);
}

TEST(Pacer, PassesAllOfASlowerStream) {
  EXPECT_EQ(count(60, 20, 0.005, 10), 200);
}

TEST(Pacer, DoesNotCatchUpAfterAPause) {
  Pacer pacer(10);
  EXPECT_TRUE(pacer.allow(100));
  EXPECT_TRUE(pacer.allow(200));
  int num_passed = 0;
  for (int i = 1; i <= 50; ++i) num_passed += pacer.allow(200 + i * 0.002);
  EXPECT_LE(num_passed, 2);
}

TEST(Pacer, OfAnyPhasePassesAStreamOfItsOwnRateWhole) {
  for (const double phase : {0.0, 0.3, 0.6, 0.9}) EXPECT_GE(count(30, 30, 0.01, 20, phase), 598);
}

TEST(Pacer, OfAnotherPhaseLetsOtherEventsThroughAlsoAfterAPause) {
  Pacer early(10);
  Pacer late(10, 0.5);
  const auto num_common = [&](double start) {
    int num_both = 0;
    for (int i = 0; i < 1000; ++i) {
      const bool is_early = early.allow(start + i * 0.01);
      num_both += static_cast<int>(late.allow(start + i * 0.01) && is_early);
    }
    return num_both;
  };
  EXPECT_LE(num_common(50), 2) << "the first, which nobody shall wait for, and its like";
  EXPECT_LE(num_common(100), 2);
}

TEST(Pacer, OfRateZeroPassesNothing) {
  Pacer pacer(0);
  EXPECT_FALSE(pacer.allow(1));
}

}  // namespace
}  // namespace nao
