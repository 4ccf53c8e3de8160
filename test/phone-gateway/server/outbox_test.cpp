#include "phone-gateway/server/outbox.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

TEST(Outbox, GivesAStateBeforeAImageButOnlyOnce) {
  Outbox outbox;
  outbox.want_state();
  EXPECT_EQ(outbox.next(), Outbox::Next::kState);
  outbox.take_state();
  outbox.want_image();
  outbox.want_state();
  EXPECT_EQ(outbox.next(), Outbox::Next::kState);
  outbox.take_state();
  // A client so slow that a new state is there whenever it has room still gets its image.
  outbox.want_state();
  EXPECT_EQ(outbox.next(), Outbox::Next::kImage);
  outbox.take_image();
  EXPECT_EQ(outbox.next(), Outbox::Next::kState);
  outbox.take_state();
  EXPECT_EQ(outbox.next(), Outbox::Next::kNothing);
}

}  // namespace
}  // namespace nao
