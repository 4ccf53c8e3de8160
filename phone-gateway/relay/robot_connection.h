#pragma once

#include "phone-gateway/relay/relay_socket.h"
//
#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace nao::relay {

/** A gateway without phones is silent; pings tell that it is there, after half of this time. */
inline constexpr std::chrono::seconds kRobotSilence{10};
/** The connection over which a robot's gateway learns of phones. */
class RobotConnection : public std::enable_shared_from_this<RobotConnection> {
 public:
  RobotConnection(WebStream stream, std::function<void()> ended)
      : socket_(std::move(stream)), ended_(std::move(ended)) {}
  ~RobotConnection() { ended_(); }

  void start(WebRequest request) {
    prepare(socket_, kRobotSilence, true);
    socket_.text(true);
    request_ = std::move(request);
    socket_.async_accept(request_, [self = shared_from_this()](const error_code& error) {
      if (error) return;
      self->is_open_ = true;
      // Tells that the relay has accepted the robot.
      self->tickets_.emplace_front("connected");
      self->read();
      self->write();
    });
  }
  /** As many as phones may wait for the robot. */
  void send(const std::string& ticket) {
    tickets_.push_back(ticket);
    if (tickets_.size() == 1 && is_open_) write();
  }
  void close() { beast::get_lowest_layer(socket_).close(); }

 private:
  // A gateway has nothing to say here: its first byte ends the connection, as its end does.
  void read() {
    socket_.async_read_some(asio::buffer(byte_), [self = shared_from_this()](
                                                     const error_code&, size_t) { self->close(); });
  }
  void write() {
    if (tickets_.empty()) return;
    socket_.async_write(asio::buffer(tickets_.front()),
                        [self = shared_from_this()](const error_code& error, size_t) {
                          if (error) return self->close();
                          self->tickets_.pop_front();
                          self->write();
                        });
  }

  WebSocket socket_;
  WebRequest request_;
  std::function<void()> ended_;
  std::deque<std::string> tickets_;
  std::array<char, 1> byte_{};
  bool is_open_ = false;
};

}  // namespace nao::relay
