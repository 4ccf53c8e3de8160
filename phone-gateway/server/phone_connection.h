#pragma once

#include "phone-gateway/server/connection.h"
//
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <optional>
#include <string>

namespace nao {

/** What a phone's connection does whatever its transport: hands messages to the core, takes from it
 * what is to be sent, one at a time, and sees to its own end.
 *
 * It lives as long as an operation on its socket is under way. */
class PhoneConnection : public std::enable_shared_from_this<PhoneConnection> {
 public:
  explicit PhoneConnection(Hub& hub);
  virtual ~PhoneConnection();
  PhoneConnection(const PhoneConnection&) = delete;
  PhoneConnection& operator=(const PhoneConnection&) = delete;

 protected:
  /** The connection can take and give messages from now on. */
  void open(const Peer& peer);
  /** Hands a message to the core.
   * @return true if reading may go on; else take_more() is called later. */
  [[nodiscard]] bool receive(std::string_view message);
  /** The client broke the rules of the transport. */
  void violate(const std::string& why);
  /** The write begun by write() is over. */
  void on_written(bool has_failed);
  /** The socket is of no more use. */
  void abort(const std::string& why);
  bool is_closing() const { return hub_.core.is_closing(id_); }

  // What the transport does.
  /** Sends a message and calls on_written() later. */
  virtual void write(MessageBytes message) = 0;
  /** Reading may go on after a pause. */
  virtual void take_more() = 0;
  /** All has been sent: says so to the other end. */
  virtual void shut_down() = 0;
  /** The socket below it all. */
  virtual Tcp::socket& socket() = 0;
  /** Closes the socket at once; what is under way ends with an error. */
  virtual void close_socket() = 0;

  Hub& hub_;

 private:
  /** Sends what is next: an image when it is its turn, all else at once. */
  void flush_in_turn();
  void flush();
  void limit(std::chrono::seconds time);
  void wait_for_limit();
  void leave_waiting_room();
  void finish(const std::string& why);

  asio::steady_timer pause_;
  asio::steady_timer limit_;
  /** When what is being sent must have left. The timer is not set anew for each message: it looks
   * at this when it rings. */
  std::optional<asio::steady_timer::time_point> deadline_;
  bool is_limit_waiting_ = false;
  uint32_t id_ = 0;
  WaitingRoom::Place place_;
  bool is_waiting_ = false;
  bool is_flush_due_ = false;
  bool is_image_due_ = false;
  bool is_writing_ = false;
  bool is_shut_down_ = false;
  bool is_finished_ = false;
};

}  // namespace nao
