#include "phone-gateway/web_stream/asio_loop.h"

#include <csignal>

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

void AsioLoop::wait(Watched& watched) {
  watched.descriptor.async_wait(asio::posix::stream_descriptor::wait_read,
                                [this, &watched](const error_code& error) {
                                  if (error) return;
                                  watched.handler();
                                  wait(watched);
                                });
}

void AsioLoop::every(double period, std::function<void()> handler) {
  timers_.push_back(
      {asio::steady_timer(io_, Clock::now()), to_duration(period), std::move(handler)});
  wait(timers_.back());
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
