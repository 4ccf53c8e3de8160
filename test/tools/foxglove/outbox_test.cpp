#include "tools/foxglove/outbox.h"

#include <gtest/gtest.h>

namespace nao::foxglove {
namespace {

OutgoingMessage message(const std::string& head, size_t body = 0) {
  return {false, head, std::make_shared<const std::string>(body, 'x')};
}

std::string drain(Outbox& outbox) {
  std::string heads;
  while (const auto next = outbox.next()) heads += next->head;
  EXPECT_EQ(outbox.num_bytes(), 0u);
  return heads;
}

TEST(Outbox, KeepsTheNewestMessagesOfAChannel) {
  Outbox outbox(1000);
  for (char letter = 'a'; letter <= 'z'; ++letter) outbox.add(1, message(std::string(1, letter)));
  outbox.add(2, message("2"));
  EXPECT_EQ(drain(outbox), "qrstuvwxyz2");
  EXPECT_EQ(outbox.num_dropped(), 16);
}

TEST(Outbox, KeepsOneLargeMessageOfAChannel) {
  Outbox outbox(1'000'000);
  outbox.add(1, message("a", Outbox::kLargeBytes));
  outbox.add(1, message("b", Outbox::kLargeBytes));
  EXPECT_EQ(drain(outbox), "b");
}

TEST(Outbox, DropsOldMessagesForSpaceButNoAnswers) {
  Outbox outbox(100);
  outbox.add(1, message("a", 49));
  EXPECT_TRUE(outbox.add_answer(message("b", 29)));
  outbox.add(2, message("c", 39));
  EXPECT_EQ(outbox.num_bytes(), 70u);
  EXPECT_EQ(drain(outbox), "bc");
  EXPECT_TRUE(outbox.add_answer(message("d", 59)));
  EXPECT_FALSE(outbox.add_answer(message("e", 59))) << "the client does not read";
  outbox.add(1, message("f", 59));
  EXPECT_EQ(drain(outbox), "d");
}

TEST(Outbox, ForgetsAChannel) {
  Outbox outbox(100);
  outbox.add(1, message("a"));
  outbox.add(2, message("b"));
  outbox.forget(1);
  EXPECT_EQ(drain(outbox), "b");
}

}  // namespace
}  // namespace nao::foxglove
