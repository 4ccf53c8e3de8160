#include "sim/pacer.h"

#include <gtest/gtest.h>

namespace nao::sim {
namespace {

/** Runs ticks that the machine delays by delay(tick), for `duration` wall seconds. */
template <class Delay>
int count_ticks(Pacer& pacer, double duration, Delay delay) {
  double now = 0;
  int ticks = 0;
  while (true) {
    now = std::max(now, pacer.next(now)) + delay(ticks);
    if (now > duration) return ticks;
    pacer.tick(now);
    ++ticks;
  }
}

TEST(Pacer, KeepsPaceWithTheWallClockIfEveryTickIsLate) {
  Pacer pacer(0.01);
  pacer.set_pace(1, 0);
  EXPECT_NEAR(count_ticks(pacer, 100, [](int) { return 0.004; }), 10000, 100);
}

TEST(Pacer, CatchesUpWithADelayWithoutABurst) {
  Pacer pacer(0.01);
  pacer.set_pace(1, 0);
  EXPECT_NEAR(count_ticks(pacer, 10, [](int tick) { return tick == 100 ? 0.2 : 0.0; }), 1000, 2);

  pacer.set_pace(1, 0);
  pacer.tick(0.2);
  EXPECT_GE(pacer.next(0.2), 0.205);
}

TEST(Pacer, SkipsALongStop) {
  Pacer pacer(0.01);
  pacer.set_pace(1, 0);
  EXPECT_NEAR(count_ticks(pacer, 20, [](int tick) { return tick == 100 ? 10.0 : 0.0; }), 1000, 5);
}

TEST(Pacer, FollowsTheRequestedPace) {
  Pacer pacer(0.01);
  pacer.set_pace(0.5, 0);
  EXPECT_NEAR(count_ticks(pacer, 10, [](int) { return 0.0; }), 500, 2);
  pacer.set_pace(0, 0);
  EXPECT_LE(pacer.next(3), 3);
}

}  // namespace
}  // namespace nao::sim
