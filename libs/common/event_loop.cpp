#include "common/event_loop.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>

#include "common/error.h"
#include "common/wall_clock.h"

namespace nao {
namespace {

timespec to_timespec(double seconds) {
  timespec result{};
  result.tv_sec = static_cast<time_t>(seconds);
  result.tv_nsec =
      static_cast<long>(std::lround((seconds - static_cast<double>(result.tv_sec)) * 1e9));
  return result;
}

/** Thread of the newest loop, to which other threads pass signals on. */
std::atomic<pthread_t> loop_thread;

void pass_on(int signal) {
  pthread_kill(loop_thread, signal);
}

}  // namespace

EventLoop::EventLoop() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  // Blocked signals are read from a descriptor like any other event: no handler interrupts a step,
  // and no signal is lost between a check and poll().
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  // Threads that were there before, as those of OpenBLAS, do not block them.
  loop_thread = pthread_self();
  struct sigaction action = {};
  action.sa_handler = pass_on;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  signal_descriptor_ = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  if (signal_descriptor_ < 0) {
    throw Error(std::string("cannot create a signal descriptor: ") + std::strerror(errno));
  }
}

EventLoop::~EventLoop() {
  for (const Source& source : sources_) {
    if (source.period > 0) close(source.descriptor);
  }
  close(signal_descriptor_);
}

void EventLoop::on_readable(int descriptor, std::function<void()> handler) {
  sources_.push_back(
      {descriptor, 0, std::make_shared<const std::function<void()>>(std::move(handler))});
}

void EventLoop::set_watched(int descriptor, bool is_watched) {
  for (Source& source : sources_) {
    if (source.descriptor == descriptor) source.is_watched = is_watched;
  }
}

// Marked only: the list must not change while run() goes through it.
void EventLoop::forget(int descriptor) {
  for (Source& source : sources_) {
    if (source.period == 0 && source.descriptor == descriptor) source.descriptor = -1;
  }
}

int EventLoop::every(double period, std::function<void()> handler) {
  return add_timer(monotonic_seconds() + period, period, std::move(handler));
}

int EventLoop::every_aligned(double period, std::function<void()> handler) {
  const double next = (std::floor(monotonic_seconds() / period) + 1) * period;
  return add_timer(next, period, std::move(handler));
}

int EventLoop::add_timer(double first, double period, std::function<void()> handler) {
  const int descriptor = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
  // The kernel repeats the timer: a late handler does not shift the later ones.
  const itimerspec timing{to_timespec(period), to_timespec(first)};
  if (descriptor < 0 || timerfd_settime(descriptor, TFD_TIMER_ABSTIME, &timing, nullptr) != 0) {
    throw Error(std::string("cannot create a timer: ") + std::strerror(errno));
  }
  sources_.push_back(
      {descriptor, period, std::make_shared<const std::function<void()>>(std::move(handler))});
  return descriptor;
}

void EventLoop::set_period(int timer, double period) {
  const auto source = std::find_if(sources_.begin(), sources_.end(), [timer](const Source& each) {
    return each.descriptor == timer;
  });
  if (source == sources_.end() || source->period == period) return;
  source->period = period;
  restart(timer);
}

void EventLoop::restart(int timer) {
  for (const Source& source : sources_) {
    if (source.descriptor != timer) continue;
    const itimerspec timing{to_timespec(source.period), to_timespec(source.period)};
    timerfd_settime(timer, 0, &timing, nullptr);
  }
}

// Signals first, then sources in the order in which they were added.
std::string EventLoop::run() {
  std::vector<pollfd> polled;
  while (!is_stopped_) {
    // Forgotten sources are removed here, between two waits.
    std::erase_if(sources_, [](const Source& source) { return source.descriptor < 0; });
    polled.clear();
    polled.push_back({signal_descriptor_, POLLIN, 0});
    // poll() ignores a descriptor of -1.
    for (const Source& source : sources_) {
      polled.push_back({source.is_watched ? source.descriptor : -1, POLLIN, 0});
    }
    if (poll(polled.data(), polled.size(), -1) < 0) {
      if (errno == EINTR) continue;
      throw Error(std::string("cannot wait for events: ") + std::strerror(errno));
    }
    if (polled[0].revents != 0) {
      signalfd_siginfo signal{};
      if (read(signal_descriptor_, &signal, sizeof signal) == sizeof signal) {
        stop(signal.ssi_signo == SIGINT ? "SIGINT" : "SIGTERM");
        break;
      }
    }
    // By index: a handler may add sources.
    for (size_t i = 1; i < polled.size() && !is_stopped_; ++i) {
      // Forgotten by a handler of this round.
      if (polled[i].revents == 0 || sources_[i - 1].descriptor < 0) continue;
      if (sources_[i - 1].period > 0) {
        uint64_t expirations = 0;
        // Periods that have passed meanwhile are one event: a loop that was held up does not catch
        // up with a burst.
        if (read(sources_[i - 1].descriptor, &expirations, sizeof expirations) < 0) continue;
      }
      // A copy: the handler may forget its own source.
      const auto handler = sources_[i - 1].handler;
      (*handler)();
    }
  }
  // run() may be called again.
  is_stopped_ = false;
  return reason_;
}

void EventLoop::stop(const std::string& reason) {
  is_stopped_ = true;
  reason_ = reason;
}

}  // namespace nao
