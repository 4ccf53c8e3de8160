#include "phone-gateway/server/core/outbox.h"

#include <gtest/gtest.h>

namespace nao::gateway {
namespace {

TEST(Outbox, SendsOneStateBeforeAnImage) {
  Outbox outbox;
  outbox.request_state();
  EXPECT_EQ(outbox.next(true), Outbox::Next::kState);
  outbox.take_state();
  outbox.request_image();
  outbox.request_state();
  EXPECT_EQ(outbox.next(true), Outbox::Next::kState);
  outbox.take_state();
  // A client so slow that a new state is due whenever it can take a message still gets its image.
  outbox.request_state();
  EXPECT_EQ(outbox.next(true), Outbox::Next::kImage);
  outbox.take_image();
  EXPECT_EQ(outbox.next(true), Outbox::Next::kState);
  outbox.take_state();
  EXPECT_EQ(outbox.next(true), Outbox::Next::kNothing);
}

TEST(Outbox, InsertsAMessageBeforeLaterOnes) {
  Outbox outbox;
  const auto message = [](const char* text) { return std::make_shared<const std::string>(text); };
  outbox.push(message("first"));
  const size_t position = outbox.num_messages();
  outbox.push(message("third"));
  outbox.insert(position, message("second"));
  for (const char* text : {"first", "second", "third"}) EXPECT_EQ(*outbox.take_message(), text);
}

TEST(Outbox, ServesStatesAudioAndImagesOfASlowClientInTurn) {
  Outbox outbox;
  const auto piece = std::make_shared<const std::string>("piece");
  for (int i = 0; i < 3; ++i) outbox.push_audio(piece);
  std::string order;
  for (int i = 0; i < 9; ++i) {
    outbox.request_state();
    outbox.request_image();
    switch (outbox.next(true)) {
      case Outbox::Next::kState:
        outbox.take_state();
        order += 's';
        break;
      case Outbox::Next::kAudio:
        (void)outbox.take_audio();
        order += 'a';
        break;
      default:
        outbox.take_image();
        order += 'i';
    }
  }
  EXPECT_EQ(order, "saisaisai");
}

TEST(Outbox, DropsTheOldestAudioOfASlowClient) {
  Outbox outbox;
  for (int i = 0; i < 20; ++i) {
    outbox.push_audio(std::make_shared<const std::string>(std::to_string(i)));
  }
  EXPECT_EQ(outbox.num_skipped(), 4u);
  EXPECT_EQ(*outbox.take_audio(), "4");
  outbox.clear_audio();
  EXPECT_EQ(outbox.next(true), Outbox::Next::kNothing);
}

TEST(Outbox, CountsStatesAndImagesThatWereNotSentInTime) {
  Outbox outbox;
  for (int i = 0; i < 3; ++i) outbox.request_state();
  outbox.request_image();
  EXPECT_EQ(outbox.num_skipped(), 2u);
}

TEST(Outbox, SendsStatesWhileAnImageMayNotBeSent) {
  Outbox outbox;
  for (int i = 0; i < 3; ++i) {
    outbox.request_state();
    outbox.request_image();
    ASSERT_EQ(outbox.next(false), Outbox::Next::kState);
    outbox.take_state();
    EXPECT_EQ(outbox.next(false), Outbox::Next::kNothing);
  }
  EXPECT_EQ(outbox.next(true), Outbox::Next::kImage);
}

}  // namespace
}  // namespace nao::gateway
