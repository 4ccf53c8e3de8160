#include "sim/step_threads.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>

namespace nao::sim {
namespace {

TEST(StepThreads, CallEachItemOnceInEveryRound) {
  constexpr int kMost = 9;
  for (const int num_threads : {1, 2, 3}) {
    StepThreads threads(num_threads);
    std::array<std::atomic<int>, kMost> calls{};
    std::array<int, kMost> expected{};
    for (int round = 0; round < 3000; ++round) {
      const int count = round % (kMost + 1);
      threads.for_each(count, [&](int i) { ++calls[i]; });
      for (int i = 0; i < count; ++i) ++expected[i];
      for (int i = 0; i < kMost; ++i) ASSERT_EQ(calls[i], expected[i]) << "item " << i;
    }
  }
}

TEST(StepThreads, TakesTheItemsOfAThreadThatIsBusy) {
  StepThreads threads(2);
  std::atomic<int> num_done = 0;
  // One thread stays in its item until the other one has done all other items.
  threads.for_each(6, [&](int i) {
    if (i == 0) {
      while (num_done < 5) {
      }
    }
    ++num_done;
  });
  EXPECT_EQ(num_done, 6);
}

}  // namespace
}  // namespace nao::sim
