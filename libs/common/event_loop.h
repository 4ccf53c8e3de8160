#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace nao {

/** One thread's main loop: waits for readable file descriptors, timers, SIGINT and SIGTERM.
 *
 * From its construction on, SIGINT and SIGTERM no longer terminate the process: they end run().
 * Construct it before any thread is started (the bus starts one), so that every thread inherits the
 * blocked signals.
 *
 * Built on poll(2), signalfd(2) and timerfd_create(2). Servers of many TCP connections use
 * AsioLoop instead; the other programs need only the bus and timers and do not link Boost.Asio. */
class EventLoop {
 public:
  /** @throws Error  if the signal descriptor cannot be created. */
  EventLoop();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  /** Calls `handler` whenever `descriptor` is readable. The caller owns the descriptor and keeps it
   * open. */
  void on_readable(int descriptor, std::function<void()> handler);

  /** Whether on_readable() of a descriptor is in effect. What may wait until a timer's handler
   * reads it need not wake the process: a wake-up costs both it and the sender time. */
  void set_watched(int descriptor, bool is_watched);

  /** Ends on_readable() for a descriptor; call it before the descriptor is closed. A handler may
   * forget its own. */
  void forget(int descriptor);

  /** Calls `handler` every `period` s of the monotonic clock, first after one period. Missed
   * periods are merged into one call. @return The timer, for set_period(). */
  int every(double period, std::function<void()> handler);

  /** The same at multiples of the period, first within one: at the same times in all programs, so
   * that what they send wakes its receivers once. For periodic messages. */
  int every_aligned(double period, std::function<void()> handler);

  /** Changes the period, s, of a timer: its next call comes after one of these. No effect if it is
   * the period already. */
  void set_period(int timer, double period);

  /** The next call of a timer comes one period from now: for timeouts. */
  void restart(int timer);

  /** Runs until a signal or stop().
   * @return Reason of the end: "SIGINT", "SIGTERM" or the reason given to stop(). */
  std::string run();

  /** Ends run() after the current handler returns. */
  void stop(const std::string& reason);

 private:
  struct Source {
    /** -1: forgotten. */
    int descriptor;
    /** Period of a timer, s; 0: not a timer. */
    double period;
    /** Shared with the call that is running, during which the source may be forgotten. */
    std::shared_ptr<const std::function<void()>> handler;
    bool is_watched = true;
  };

  /** @param first  Time of the first call, s of the monotonic clock. */
  int add_timer(double first, double period, std::function<void()> handler);

  std::vector<Source> sources_;
  int signal_descriptor_;
  bool is_stopped_ = false;
  std::string reason_;
};

}  // namespace nao
