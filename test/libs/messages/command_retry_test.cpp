#include "messages/command_retry.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

constexpr CommandRetry::Timing kTiming{
    .repeat_period = 0.1, .confirm_period = 1, .answer_timeout = 1.5, .silence_timeout = 3};

TEST(CommandRetry, SendsAtOnceAndThenOnceAPeriod) {
  CommandRetry retry(kTiming, 10);
  EXPECT_TRUE(retry.should_send(10));
  EXPECT_FALSE(retry.should_send(10.05));
  EXPECT_TRUE(retry.should_send(10.11));
  EXPECT_FALSE(retry.should_send(10.15)) << "the period counts from the last transmission";
  EXPECT_TRUE(retry.should_send(10.22));
}

TEST(CommandRetry, RepeatsAnAcceptedCommandAtTheConfirmPeriod) {
  CommandRetry retry(kTiming, 10);
  EXPECT_TRUE(retry.should_send(10));
  EXPECT_TRUE(retry.handle_result(ResultStatus::kAccepted, 10.05));
  EXPECT_FALSE(retry.should_send(10.9));
  EXPECT_TRUE(retry.should_send(11.01));
}

TEST(CommandRetry, DoesNotRepeatAnAcceptedCommandByDefault) {
  CommandRetry retry({}, 10);
  EXPECT_TRUE(retry.should_send(10));
  retry.handle_result(ResultStatus::kAccepted, 10.05);
  EXPECT_FALSE(retry.should_send(1e9));
  EXPECT_FALSE(retry.has_timed_out(1e9));
}

TEST(CommandRetry, ReportsEachResultOnce) {
  CommandRetry retry(kTiming, 10);
  EXPECT_TRUE(retry.handle_result(ResultStatus::kAccepted, 10));
  EXPECT_FALSE(retry.handle_result(ResultStatus::kAccepted, 10));
  EXPECT_TRUE(retry.handle_result(ResultStatus::kDone, 10));
  EXPECT_FALSE(retry.handle_result(ResultStatus::kDone, 10));
  EXPECT_FALSE(retry.handle_result(ResultStatus::kAccepted, 10)) << "overtaken by the final result";
  EXPECT_TRUE(retry.is_accepted());
  EXPECT_TRUE(retry.has_ended());
}

TEST(CommandRetry, EndsWithAFinalResult) {
  for (const auto status : {ResultStatus::kRefused, ResultStatus::kDone, ResultStatus::kInterrupted,
                            ResultStatus::kFailed}) {
    CommandRetry retry(kTiming, 10);
    EXPECT_TRUE(retry.handle_result(status, 10));
    EXPECT_FALSE(retry.should_send(20)) << to_string(status);
    EXPECT_FALSE(retry.has_timed_out(20)) << to_string(status);
  }
}

TEST(CommandRetry, TimesOutWithoutAnAnswer) {
  CommandRetry retry(kTiming, 10);
  retry.handle_sign_of_life(11);
  EXPECT_FALSE(retry.has_timed_out(11.4));
  EXPECT_TRUE(retry.has_timed_out(11.5)) << "a receiver that runs has not received the command";
}

TEST(CommandRetry, TimesOutWhenTheReceiverOfAnAcceptedCommandFallsSilent) {
  CommandRetry retry(kTiming, 10);
  retry.handle_result(ResultStatus::kAccepted, 10.5);
  EXPECT_FALSE(retry.has_timed_out(13.4));
  retry.handle_sign_of_life(13);
  EXPECT_FALSE(retry.has_timed_out(15.9));
  EXPECT_TRUE(retry.has_timed_out(16));
}

}  // namespace
}  // namespace nao
