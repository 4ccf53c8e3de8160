#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <list>
#include <string>

namespace nao {

/** Next time of a periodic timer: from the planned time, so that the period is kept; never in the
 * past, so that a delay is not followed by a burst. */
template <class Time, class Duration>
Time next_time(Time planned, Duration period, Time now) {
  const Time next = planned + period;
  return next > now ? next : now;
}

/** EventLoop for servers of many TCP connections, on Boost.Asio: timers, file descriptors, SIGINT
 * and SIGTERM beside the sockets of io(), in one thread. */
class AsioLoop {
 public:
  AsioLoop();
  ~AsioLoop();
  AsioLoop(const AsioLoop&) = delete;
  AsioLoop& operator=(const AsioLoop&) = delete;

  boost::asio::io_context& io() { return io_; }

  /** Calls `handler` whenever `descriptor` is readable. The caller keeps it open. */
  void on_readable(int descriptor, std::function<void()> handler);

  /** Whether on_readable() of a descriptor is in effect; one call may come after its end. */
  void set_watched(int descriptor, bool is_watched);

  /** Calls `handler` every `period` s, first after one period; see next_time().
   * @return The timer, for set_period(). */
  size_t every(double period, std::function<void()> handler);

  /** The same at multiples of the period of the monotonic clock, see EventLoop::every_aligned(). */
  size_t every_aligned(double period, std::function<void()> handler);

  /** Changes the period, s, of a timer: its next call comes after one of these. No effect if it is
   * the period already. */
  void set_period(size_t timer, double period);

  /** The next call of a timer comes one period from now. */
  void restart(size_t timer);

  /** Runs until a signal or stop(). @return "SIGINT", "SIGTERM" or the reason passed to stop(). */
  std::string run();

  /** Runs for `time` s, or until nothing is left to do. */
  void run_for(double time);

  /** Ends run(), from within a handler. */
  void stop(const std::string& reason);

 private:
  struct Watched {
    boost::asio::posix::stream_descriptor descriptor;
    std::function<void()> handler;
    bool is_watched = true;
    bool is_waiting = false;
  };
  struct Timer {
    boost::asio::steady_timer timer;
    std::chrono::nanoseconds period;
    std::function<void()> handler;
  };
  void wait(Watched& watched);
  void wait(Timer& timer);
  size_t add_timer(boost::asio::steady_timer::time_point planned, double period,
                   std::function<void()> handler);

  boost::asio::io_context io_{1};
  boost::asio::signal_set signals_;
  std::list<Watched> watched_;
  std::list<Timer> timers_;
  std::string reason_;
};

}  // namespace nao
