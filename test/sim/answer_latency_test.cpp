#include "sim/answer_latency.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao::sim {
namespace {

TEST(AnswerLatency, IsInfiniteUntilARecentTickIsAnswered) {
  AnswerLatency latency;
  EXPECT_TRUE(std::isinf(latency.least()));
  latency.note_tick(7, 1.0);
  latency.note_answer(6, 1.001);
  latency.note_answer(-1, 1.001);
  EXPECT_TRUE(std::isinf(latency.least()));
  latency.note_tick(7 + 128, 2.28);
  latency.note_answer(7, 2.281);
  EXPECT_TRUE(std::isinf(latency.least()));
  latency.note_answer(7 + 128, 2.281);
  EXPECT_NEAR(latency.least(), 0.001, 1e-9);
}

/** Ticks of 10 ms from `begin` to `end`, each answered after `delay` s. */
void answer_ticks(AnswerLatency& meter, int begin, int end, double delay) {
  const int ticks_late = static_cast<int>(std::ceil(delay / 0.01));
  for (int tick = begin; tick < end; ++tick) {
    meter.note_tick(tick, tick * 0.01);
    meter.note_answer(tick - ticks_late, (tick - ticks_late) * 0.01 + delay);
  }
}

TEST(AnswerLatency, IsTheLeastOfTheLastSecond) {
  AnswerLatency latency;
  answer_ticks(latency, 0, 300, 0.04);
  EXPECT_NEAR(latency.least(), 0.04, 1e-9);
  answer_ticks(latency, 300, 310, 0.002);
  answer_ticks(latency, 310, 400, 0.04);
  EXPECT_NEAR(latency.least(), 0.002, 1e-9);
  answer_ticks(latency, 400, 600, 0.04);
  EXPECT_NEAR(latency.least(), 0.04, 1e-9);
}

}  // namespace
}  // namespace nao::sim
