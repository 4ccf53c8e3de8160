#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace nao {

/** One thread's main loop: waits for readable file descriptors, timers, SIGINT and SIGTERM.
 *
 * From its construction on, SIGINT and SIGTERM no longer kill the process: they end run().
 * Construct it before any thread is started (the bus starts one), so that every thread leaves them
 * alone. */
class EventLoop {
 public:
  /** @throws Error  if the system refuses a signal descriptor. */
  EventLoop();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  /** Calls `handler` whenever `descriptor` has something to read. The caller keeps it open. */
  void on_readable(int descriptor, std::function<void()> handler);

  /** Calls `handler` every `period` seconds of the monotonic clock, first after one period. A late
   * loop calls it once, not once for every missed period. */
  void every(double period, std::function<void()> handler);

  /** Runs until a signal or stop().
   * @return Why it ended: "SIGINT", "SIGTERM" or the reason given to stop(). */
  std::string run();

  /** Ends run() after the handler that is running. */
  void stop(const std::string& reason);

 private:
  struct Source {
    int descriptor;
    bool is_timer;
    std::function<void()> handler;
  };

  std::vector<Source> sources_;
  int signal_descriptor_;
  bool is_stopped_ = false;
  std::string reason_;
};

}  // namespace nao
