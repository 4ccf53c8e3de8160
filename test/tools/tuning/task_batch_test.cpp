#include "tools/tuning/task_batch.h"

#include <gtest/gtest.h>

#include <vector>

#include "common/error.h"
#include "common/random.h"

namespace nao {
namespace {

/** Runs a batch with workers that finish in random order; the figures of a task are its index. */
std::vector<Outcome> run_in_random_order(size_t num_tasks, const std::vector<int>& slots,
                                         uint64_t seed) {
  Random random(seed);
  TaskBatch batch(num_tasks, slots);
  std::vector<std::pair<size_t, size_t>> running;  // worker, task
  while (!batch.is_done()) {
    for (size_t worker = 0; worker < slots.size(); ++worker) {
      while (const auto index = batch.assign(worker)) running.emplace_back(worker, *index);
    }
    const size_t which = random.next() % running.size();
    const auto [worker, index] = running[which];
    running.erase(running.begin() + static_cast<long>(which));
    batch.finish(worker, {.index = index, .figures = {static_cast<double>(index)}});
  }
  return batch.take();
}

TEST(TaskBatch, OrdersOutcomesByTaskWhateverTheOrderInWhichTheyArrive) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const std::vector<Outcome> outcomes = run_in_random_order(17, {1, 3, 2}, seed);
    ASSERT_EQ(outcomes.size(), 17u);
    for (size_t i = 0; i < outcomes.size(); ++i) {
      EXPECT_EQ(outcomes[i].figures, Figures{static_cast<double>(i)});
    }
  }
}

TEST(TaskBatch, GivesAWorkerNoMoreTasksThanItHasSlots) {
  TaskBatch batch(5, {2, 0});
  EXPECT_EQ(batch.assign(0), 0u);
  EXPECT_EQ(batch.assign(1), std::nullopt);
  EXPECT_EQ(batch.assign(0), 1u);
  EXPECT_EQ(batch.assign(0), std::nullopt);
  batch.finish(0, {.index = 1});
  EXPECT_EQ(batch.assign(0), 2u);
}

TEST(TaskBatch, RefusesOutcomesOfTasksThatTheWorkerDoesNotRun) {
  TaskBatch batch(3, {1, 1});
  batch.assign(0);
  EXPECT_THROW(batch.finish(1, {.index = 0}), Error);
  EXPECT_THROW(batch.finish(0, {.index = 7}), Error);
  batch.finish(0, {.index = 0});
  EXPECT_THROW(batch.finish(0, {.index = 0}), Error);
}

TEST(TaskBatch, ReportsTheFirstFailedTaskInTheOrderOfTasks) {
  TaskBatch batch(3, {3});
  while (batch.assign(0)) {
  }
  batch.finish(0, {.index = 2, .error = "third"});
  batch.finish(0, {.index = 1, .error = "second"});
  batch.finish(0, {.index = 0});
  try {
    (void)batch.take();
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "second");
  }
}

TEST(TaskBatch, OfNoTasksIsDone) {
  TaskBatch batch(0, {1});
  EXPECT_TRUE(batch.is_done());
  EXPECT_TRUE(batch.take().empty());
}

}  // namespace
}  // namespace nao
