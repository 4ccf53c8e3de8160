#include "sim/answer_delay.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao::sim {
namespace {

TEST(AnswerDelay, IsInfiniteUntilATickOfLateIsAnswered) {
  AnswerDelay delay;
  EXPECT_TRUE(std::isinf(delay.least()));
  delay.note_tick(7, 1.0);
  delay.note_answer(6, 1.001);
  delay.note_answer(-1, 1.001);
  EXPECT_TRUE(std::isinf(delay.least()));
  delay.note_tick(7 + 128, 2.28);
  delay.note_answer(7, 2.281);
  EXPECT_TRUE(std::isinf(delay.least()));
  delay.note_answer(7 + 128, 2.281);
  EXPECT_NEAR(delay.least(), 0.001, 1e-9);
}

/** Ticks of 10 ms from `begin` to `end`, each answered after `delay` s. */
void answer_ticks(AnswerDelay& meter, int begin, int end, double delay) {
  const int ticks_late = static_cast<int>(std::ceil(delay / 0.01));
  for (int tick = begin; tick < end; ++tick) {
    meter.note_tick(tick, tick * 0.01);
    meter.note_answer(tick - ticks_late, (tick - ticks_late) * 0.01 + delay);
  }
}

TEST(AnswerDelay, IsThatOfTheBestAnswerInTheLastSecond) {
  AnswerDelay delay;
  answer_ticks(delay, 0, 300, 0.04);
  EXPECT_NEAR(delay.least(), 0.04, 1e-9);
  answer_ticks(delay, 300, 310, 0.002);
  answer_ticks(delay, 310, 400, 0.04);
  EXPECT_NEAR(delay.least(), 0.002, 1e-9);
  answer_ticks(delay, 400, 600, 0.04);
  EXPECT_NEAR(delay.least(), 0.04, 1e-9);
}

}  // namespace
}  // namespace nao::sim
