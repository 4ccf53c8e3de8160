#include "tools/nao/command_exchange.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

TEST(CommandExchange, RepeatsQuicklyUntilAnsweredThenSlowly) {
  CommandExchange exchange("nao-motion", 0);
  int num_sent = 0;
  for (int i = 0; i < 100; ++i) num_sent += exchange.should_send(i * 0.01) ? 1 : 0;
  EXPECT_EQ(num_sent, 10);

  exchange.handle_result(ResultStatus::kAccepted, "", 1.0);
  num_sent = 0;
  for (int i = 0; i < 300; ++i) num_sent += exchange.should_send(1.0 + i * 0.01) ? 1 : 0;
  EXPECT_EQ(num_sent, 3);
}

TEST(CommandExchange, HasNoOutcomeUntilTheFinalResult) {
  CommandExchange exchange("nao-motion", 0);
  EXPECT_FALSE(exchange.outcome(0.1));
  exchange.handle_result(ResultStatus::kAccepted, "", 0.2);
  EXPECT_TRUE(exchange.is_accepted());
  EXPECT_FALSE(exchange.outcome(0.3));
  exchange.handle_result(ResultStatus::kDone, "", 0.4);
  ASSERT_TRUE(exchange.outcome(0.5));
  EXPECT_TRUE(exchange.outcome(0.5)->is_success);
}

TEST(CommandExchange, KeepsTheReasonOfARefusal) {
  CommandExchange exchange("nao-motion", 0);
  exchange.handle_result(ResultStatus::kRefused, "no posture Handstand", 0.1);
  ASSERT_TRUE(exchange.outcome(0.1));
  EXPECT_FALSE(exchange.outcome(0.1)->is_success);
  EXPECT_EQ(exchange.outcome(0.1)->status, "refused");
  EXPECT_EQ(exchange.outcome(0.1)->reason, "no posture Handstand");
}

TEST(CommandExchange, TimesOutUnansweredEvenIfMotionPublishes) {
  CommandExchange exchange("nao-motion", 0);
  for (int i = 0; i < 14; ++i) exchange.handle_sign_of_life(i * 0.1);
  EXPECT_FALSE(exchange.outcome(1.4));
  ASSERT_TRUE(exchange.outcome(1.6));
  EXPECT_EQ(exchange.outcome(1.6)->status, "unanswered");
}

TEST(CommandExchange, WaitsForAnAcceptedCommandWhileMotionPublishes) {
  CommandExchange exchange("nao-motion", 0);
  exchange.handle_result(ResultStatus::kAccepted, "", 0.1);
  for (double now = 1; now < 600; now += 1) {
    exchange.handle_sign_of_life(now);
    ASSERT_FALSE(exchange.outcome(now + 0.9)) << now;
  }
  ASSERT_TRUE(exchange.outcome(603));
  EXPECT_EQ(exchange.outcome(603)->status, "silent");
}

TEST(CommandExchange, KeepsItsFirstFinalResult) {
  CommandExchange exchange("nao-motion", 0);
  exchange.handle_result(ResultStatus::kInterrupted, "a newer command came", 0.1);
  exchange.handle_result(ResultStatus::kDone, "", 0.2);
  EXPECT_EQ(exchange.outcome(0.2)->status, "interrupted");
}

}  // namespace
}  // namespace nao
