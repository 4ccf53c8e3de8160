#include "messages/result_reminder.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

CommandResult result(int64_t id, ResultStatus status) {
  return {"test", id, CommandKind::kPosture, status};
}

TEST(ResultReminder, RepeatsAFinalResultTwice) {
  ResultReminder reminder;
  reminder.note(result(1, ResultStatus::kDone));
  EXPECT_TRUE(reminder.due(0.09).empty());
  ASSERT_EQ(reminder.due(0.02).size(), 1u);
  EXPECT_TRUE(reminder.due(0.3).empty());
  ASSERT_EQ(reminder.due(0.1).size(), 1u);
  EXPECT_TRUE(reminder.due(10).empty());
}

TEST(ResultReminder, RepeatsNoResultThatTheSenderAsksForItself) {
  ResultReminder reminder;
  reminder.note(result(1, ResultStatus::kAccepted));
  reminder.note(result(2, ResultStatus::kRefused));
  EXPECT_TRUE(reminder.due(1).empty());
}

TEST(ResultReminder, DropsTheOldestOfTooMany) {
  ResultReminder reminder;
  const auto num_results = static_cast<int64_t>(ResultReminder::kMaxResults) + 10;
  for (int64_t id = 1; id <= num_results; ++id) reminder.note(result(id, ResultStatus::kDone));
  const auto due = reminder.due(0.2);
  ASSERT_EQ(due.size(), ResultReminder::kMaxResults);
  EXPECT_EQ(due.front().id, 11);
}

}  // namespace
}  // namespace nao
