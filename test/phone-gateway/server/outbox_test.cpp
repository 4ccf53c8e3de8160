#include "phone-gateway/server/outbox.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

TEST(Outbox, GivesAStateBeforeAPictureButOnlyOnce) {
  Outbox outbox;
  outbox.want_state();
  EXPECT_EQ(outbox.next(), Outbox::Next::kState);
  outbox.take_state();
  outbox.want_picture();
  outbox.want_state();
  EXPECT_EQ(outbox.next(), Outbox::Next::kState);
  outbox.take_state();
  // A client so slow that a new state is there whenever it has room still gets its picture.
  outbox.want_state();
  EXPECT_EQ(outbox.next(), Outbox::Next::kPicture);
  outbox.take_picture();
  EXPECT_EQ(outbox.next(), Outbox::Next::kState);
  outbox.take_state();
  EXPECT_EQ(outbox.next(), Outbox::Next::kNothing);
}

}  // namespace
}  // namespace nao
