#include "phone-gateway/web_stream/asio_loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace nao {
namespace {

TEST(AsioLoop, KeepsAPeriodWhateverAHandlerTakes) {
  double planned = 0;
  for (int i = 1; i <= 100; ++i) {
    planned = next_time(planned, 1.0, planned + 0.6);
    ASSERT_EQ(planned, i);
  }
}

TEST(AsioLoop, MergesThePeriodsOfADelay) {
  EXPECT_EQ(next_time(1.0, 1.0, 5.5), 5.5);
}

TEST(AsioLoop, CallsTimersAndReadersUntilItIsStopped) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  {
    AsioLoop loop;
    int num_calls = 0;
    loop.every(0.001, [&] {
      if (++num_calls != 3) return;
      EXPECT_EQ(write(ends[1], "x", 1), 1);
    });
    loop.on_readable(ends[0], [&] {
      char byte;
      EXPECT_EQ(read(ends[0], &byte, 1), 1);
      loop.stop("read");
    });
    EXPECT_EQ(loop.run(), "read");
    EXPECT_GE(num_calls, 3);
    // A descriptor that is not watched, until a slow timer has become fast.
    EXPECT_EQ(write(ends[1], "x", 1), 1);
    loop.set_watched(ends[0], false);
    const size_t timer = loop.every(1000, [&] { loop.set_watched(ends[0], true); });
    loop.set_period(timer, 0.001);
    EXPECT_EQ(loop.run(), "read");
  }
  EXPECT_EQ(close(ends[0]), 0) << "the caller owns the descriptor";
  EXPECT_EQ(close(ends[1]), 0);
}

}  // namespace
}  // namespace nao
