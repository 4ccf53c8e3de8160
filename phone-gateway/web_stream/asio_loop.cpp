#include "phone-gateway/web_stream/asio_loop.h"

#include <csignal>
#include <iterator>
#include <utility>

namespace nao {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using Clock = asio::steady_timer::clock_type;

std::chrono::nanoseconds to_duration(double seconds) {
  return std::chrono::nanoseconds(static_cast<int64_t>(seconds * 1e9));
}

}  // namespace

AsioLoop::AsioLoop() : signals_(io_, SIGINT, SIGTERM) {
  signals_.async_wait([this](const error_code& error, int signal) {
    if (!error) stop(signal == SIGINT ? "SIGINT" : "SIGTERM");
  });
}

AsioLoop::~AsioLoop() {
  // The caller owns these descriptors.
  for (Watched& watched : watched_) watched.descriptor.release();
}

void AsioLoop::on_readable(int descriptor, std::function<void()> handler) {
  watched_.push_back({asio::posix::stream_descriptor(io_, descriptor), std::move(handler)});
  wait(watched_.back());
}

void AsioLoop::set_watched(int descriptor, bool is_watched) {
  for (Watched& watched : watched_) {
    if (watched.descriptor.native_handle() != descriptor) continue;
    watched.is_watched = is_watched;
    if (is_watched && !watched.is_waiting) wait(watched);
  }
}

void AsioLoop::wait(Watched& watched) {
  watched.is_waiting = true;
  watched.descriptor.async_wait(asio::posix::stream_descriptor::wait_read,
                                [this, &watched](const error_code& error) {
                                  if (error) return;
                                  watched.is_waiting = false;
                                  watched.handler();
                                  if (watched.is_watched && !watched.is_waiting) wait(watched);
                                });
}

size_t AsioLoop::every(double period, std::function<void()> handler) {
  return add_timer(Clock::now(), period, std::move(handler));
}

size_t AsioLoop::every_aligned(double period, std::function<void()> handler) {
  const auto now = Clock::now();
  return add_timer(now - now.time_since_epoch() % to_duration(period), period, std::move(handler));
}

size_t AsioLoop::add_timer(Clock::time_point planned, double period,
                           std::function<void()> handler) {
  timers_.push_back({asio::steady_timer(io_, planned), to_duration(period), std::move(handler)});
  wait(timers_.back());
  return timers_.size() - 1;
}

void AsioLoop::set_period(size_t number, double period) {
  Timer& timer = *std::next(timers_.begin(), static_cast<long>(number));
  if (timer.period == to_duration(period)) return;
  timer.period = to_duration(period);
  restart(number);
}

void AsioLoop::restart(size_t number) {
  Timer& timer = *std::next(timers_.begin(), static_cast<long>(number));
  // Within its own handler it is not waiting, and begins to afterwards.
  if (timer.timer.expires_at(Clock::now()) > 0) wait(timer);
}

void AsioLoop::wait(Timer& timer) {
  timer.timer.expires_at(next_time(timer.timer.expiry(), timer.period, Clock::now()));
  timer.timer.async_wait([this, &timer](const error_code& error) {
    if (error) return;
    timer.handler();
    wait(timer);
  });
}

std::string AsioLoop::run() {
  io_.restart();
  io_.run();
  return reason_;
}

void AsioLoop::run_for(double time) {
  io_.restart();
  io_.run_for(to_duration(time));
}

void AsioLoop::stop(const std::string& reason) {
  reason_ = reason;
  io_.stop();
}

}  // namespace nao
