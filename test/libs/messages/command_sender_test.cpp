#include "messages/command_sender.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

using Sender = CommandSender<Command, int>;
constexpr CommandTiming kTiming{
    .repeat_period = 0.1, .confirm_period = 1, .answer_timeout = 1.5, .silence_timeout = 3};

Command posture(int64_t id) {
  return {"test", id, PostureCommand{"Crouch", 0.5}};
}

Command walk(int64_t id, double vx) {
  return {"test", id, WalkCommand{vx, 0, 0}};
}

/** Forward velocities of the walk commands that are due. */
std::vector<double> take_velocities(Sender& sender, double now) {
  std::vector<double> velocities;
  for (const Command& command : sender.take_due(now)) {
    velocities.push_back(std::get<WalkCommand>(command.request).vx);
  }
  return velocities;
}

TEST(CommandSender, SendsAtOnceAndThenOnceAPeriod) {
  Sender sender;
  sender.send(posture(1), 10, 0, kTiming);
  EXPECT_EQ(sender.take_due(10).size(), 1u);
  EXPECT_EQ(sender.take_due(10.05).size(), 0u);
  EXPECT_EQ(sender.take_due(10.11).size(), 1u);
  EXPECT_EQ(sender.take_due(10.15).size(), 0u) << "the period counts from the last transmission";
  EXPECT_EQ(sender.take_due(10.22).size(), 1u);
}

TEST(CommandSender, RepeatsAnAcceptedCommandAtTheConfirmPeriod) {
  Sender sender;
  sender.send(posture(1), 10, 0, kTiming);
  sender.send(posture(2), 10);
  EXPECT_EQ(sender.take_due(10).size(), 2u);
  for (const int id : {1, 2}) sender.handle_result("test", id, ResultStatus::kAccepted, 10.05);
  EXPECT_EQ(sender.take_due(10.9).size(), 0u);
  const std::vector<Command> due = sender.take_due(11.01);
  ASSERT_EQ(due.size(), 1u) << "by default an accepted command is not repeated";
  EXPECT_EQ(due[0].id, 1);
}

TEST(CommandSender, ReportsEachResultOnceToItsReceiver) {
  Sender sender;
  sender.send(posture(5), 10, 7);
  EXPECT_FALSE(sender.handle_result("other", 5, ResultStatus::kDone, 10));
  EXPECT_FALSE(sender.handle_result("test", 6, ResultStatus::kDone, 10));
  EXPECT_EQ(sender.handle_result("test", 5, ResultStatus::kAccepted, 10)->receiver, 7);
  EXPECT_FALSE(sender.handle_result("test", 5, ResultStatus::kAccepted, 10));
  EXPECT_EQ(sender.handle_result("test", 5, ResultStatus::kFailed, 10)->receiver, 7);
  EXPECT_FALSE(sender.handle_result("test", 5, ResultStatus::kAccepted, 10)) << "overtaken";
  EXPECT_TRUE(sender.take_due(20).empty());
  EXPECT_TRUE(sender.take_timed_out(20).empty());
}

TEST(CommandSender, TimesOutWithoutAnAnswer) {
  Sender sender;
  sender.send(posture(1), 10);
  sender.handle_sign_of_life(11);
  EXPECT_TRUE(sender.take_timed_out(11.4).empty());
  EXPECT_EQ(sender.take_timed_out(11.5).size(), 1u)
      << "a receiver that runs has not received the command";
  EXPECT_TRUE(sender.entries().empty());
}

TEST(CommandSender, TimesOutWhenTheReceiverOfAnAcceptedCommandFallsSilent) {
  Sender sender;
  sender.send(posture(1), 10, 0, kTiming);
  sender.handle_result("test", 1, ResultStatus::kAccepted, 10.5);
  EXPECT_TRUE(sender.take_timed_out(13.4).empty());
  sender.handle_sign_of_life(13);
  EXPECT_TRUE(sender.take_timed_out(15.9).empty());
  EXPECT_EQ(sender.take_timed_out(16).size(), 1u);
}

TEST(CommandSender, RepeatsAWalkUntilItEnds) {
  Sender sender;
  sender.send(walk(1, 0.1), 10, 0, CommandTiming::of_stream());
  EXPECT_EQ(take_velocities(sender, 10), std::vector{0.1});
  sender.handle_result("test", 1, ResultStatus::kAccepted, 10.02);
  EXPECT_TRUE(sender.update(walk(1, 0.2), false));
  EXPECT_TRUE(take_velocities(sender, 10.05).empty());
  EXPECT_EQ(take_velocities(sender, 10.11), std::vector{0.2});
  EXPECT_TRUE(sender.update(walk(1, 0.3), true));
  EXPECT_EQ(take_velocities(sender, 10.12), std::vector{0.3});
  EXPECT_TRUE(sender.take_timed_out(1000).empty());
  sender.end(walk(1, 0));
  for (int i = 0; i < kNumLast; ++i) {
    EXPECT_EQ(take_velocities(sender, 10.13 + 0.11 * i), std::vector{0.0});
  }
  EXPECT_TRUE(take_velocities(sender, 20).empty());
  EXPECT_TRUE(sender.handle_result("test", 1, ResultStatus::kDone, 20)) << "it still has a result";
  EXPECT_FALSE(sender.update(walk(1, 0.1), true)) << "the next velocity begins another walk";
}

TEST(CommandSender, TransmitsACommandNoMoreThatSomethingReplaces) {
  Sender sender;
  sender.send(walk(1, 0.1), 10, 0, CommandTiming::of_stream());
  sender.cease(1);
  EXPECT_TRUE(sender.take_due(20).empty());
  EXPECT_TRUE(sender.handle_result("test", 1, ResultStatus::kInterrupted, 20));
}

TEST(CommandSender, GoesOnWhenTheClockWasReset) {
  Sender sender;
  sender.send(walk(1, 0.1), 10, 0, CommandTiming::of_stream());
  EXPECT_EQ(sender.take_due(10).size(), 1u);
  EXPECT_EQ(sender.take_due(0.5).size(), 1u);
  EXPECT_EQ(sender.take_due(0.55).size(), 0u);
}

TEST(CommandSender, ForgetsTheOldestOfTooManyCommands) {
  Sender sender;
  for (int64_t i = 1; i <= 1000; ++i) sender.send(posture(i), 0);
  EXPECT_EQ(sender.entries().size(), Sender::kMaxEntries);
  EXPECT_EQ(sender.entries().front().command.id, 1001 - int64_t{Sender::kMaxEntries});
}

}  // namespace
}  // namespace nao
