#include "common/event_loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <future>
#include <string>
#include <thread>

#include "common/wall_clock.h"

namespace nao {
namespace {

TEST(EventLoop, EndsOnSigtermWithItsName) {
  EventLoop loop;
  loop.every(0.001, [] { kill(getpid(), SIGTERM); });
  EXPECT_EQ(loop.run(), "SIGTERM");
}

// As a library's thread that was started when the program was loaded.
TEST(EventLoop, EndsWhenAThreadThatDoesNotBlockSignalsGetsOne) {
  std::promise<void> end;
  std::thread other([until = end.get_future()] {
    sigset_t signals;
    sigfillset(&signals);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    until.wait();
  });
  EventLoop loop;
  // NOLINTNEXTLINE(bugprone-bad-signal-to-kill-thread): the thread passes the signal on.
  loop.every(0.001, [&] { pthread_kill(other.native_handle(), SIGTERM); });
  EXPECT_EQ(loop.run(), "SIGTERM");
  end.set_value();
  other.join();
}

TEST(EventLoop, CallsTheHandlerOfAReadableDescriptor) {
  EventLoop loop;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "x", 1), 1);
  char received = 0;
  loop.on_readable(ends[0], [&] {
    ASSERT_EQ(read(ends[0], &received, 1), 1);
    loop.stop("read");
  });
  EXPECT_EQ(loop.run(), "read");
  EXPECT_EQ(received, 'x');
  close(ends[0]);
  close(ends[1]);
}

TEST(EventLoop, CallsNoHandlerOfADescriptorThatIsNotWatched) {
  EventLoop loop;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "x", 1), 1);
  bool is_watched = false;
  loop.on_readable(ends[0], [&] { loop.stop(is_watched ? "watched" : "not watched"); });
  loop.set_watched(ends[0], false);
  loop.every(0.01, [&] {
    is_watched = true;
    loop.set_watched(ends[0], true);
  });
  EXPECT_EQ(loop.run(), "watched");
  close(ends[0]);
  close(ends[1]);
}

TEST(EventLoop, AHandlerMayForgetItsOwnDescriptorAndAddAnother) {
  EventLoop loop;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "x", 1), 1);
  int num_calls = 0;
  // The descriptor stays readable. What the handler has captured must live until it returns.
  const std::string text(100, 'x');
  loop.on_readable(ends[0], [&, text] {
    ++num_calls;
    loop.forget(ends[0]);
    for (int i = 0; i < 100; ++i) loop.on_readable(ends[0], [&] { loop.stop("second"); });
    EXPECT_EQ(text, std::string(100, 'x'));
  });
  EXPECT_EQ(loop.run(), "second");
  EXPECT_EQ(num_calls, 1);
  close(ends[0]);
  close(ends[1]);
}

TEST(EventLoop, ChangesThePeriodOfATimer) {
  EventLoop loop;
  const int timer = loop.every(1000, [&loop] { loop.stop("timer"); });
  loop.set_period(timer, 0.001);
  EXPECT_EQ(loop.run(), "timer");
}

TEST(EventLoop, CallsAlignedTimersAtMultiplesOfTheirPeriod) {
  EventLoop loop;
  loop.every_aligned(0.25, [&loop] { loop.stop("aligned"); });
  const double before = monotonic_seconds();
  EXPECT_EQ(loop.run(), "aligned");
  EXPECT_GE(std::floor(monotonic_seconds() / 0.25), std::floor(before / 0.25) + 1);
}

TEST(EventLoop, ATimerThatIsRestartedDoesNotCall) {
  EventLoop loop;
  bool is_called = false;
  const int timer = loop.every(0.5, [&] { is_called = true; });
  int num_calls = 0;
  loop.every(0.01, [&] {
    loop.restart(timer);
    if (++num_calls == 100) loop.stop("enough");
  });
  EXPECT_EQ(loop.run(), "enough");
  EXPECT_TRUE(num_calls == 100 && !is_called);
}

TEST(EventLoop, CallsATimerOnceForManyMissedPeriods) {
  EventLoop loop;
  int num_calls = 0;
  loop.every(0.001, [&] {
    ++num_calls;
    if (num_calls == 1) usleep(20'000);
    if (num_calls == 3) loop.stop("enough");
  });
  EXPECT_EQ(loop.run(), "enough");
  EXPECT_EQ(num_calls, 3);
}

}  // namespace
}  // namespace nao
