#pragma once

#include "phone-gateway/server/network/connection_context.h"
//
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace nao::gateway {

/** The part of a client's connection that does not depend on its transport: passes messages to the
 * core, sends the core's messages one at a time, and closes the connection.
 *
 * A connection lives as long as an operation on its socket is in progress. */
class ClientConnection : public std::enable_shared_from_this<ClientConnection> {
 public:
  explicit ClientConnection(ConnectionContext& context);
  virtual ~ClientConnection();
  ClientConnection(const ClientConnection&) = delete;
  ClientConnection& operator=(const ClientConnection&) = delete;

  /** Sends messages until there is none or the connection takes no more. An image or a piece of
   * audio waits in a queue for its turn. */
  void flush();
  /** It is the turn of an image or a piece of audio of this connection. */
  void send_long();

 protected:
  /** Opens a session. To be called when messages can be sent and received. */
  void open(const Endpoint& endpoint);
  /** Passes a message to the core.
   * @return true if reading may continue; otherwise resume_reading() is called later. */
  [[nodiscard]] bool receive(std::string_view message);
  /** Closes the connection: the client has violated the rules of the transport. */
  void reject(const Reason& reason);
  /** The write that write() has started, and not finished, is complete. */
  void on_written(bool has_failed);
  /** Ends the session and closes the socket. @param why  For the audit log. */
  void abort(const std::string& why);
  bool is_closing() const { return context_.core.is_closing(id_); }

  // Operations of the transport.
  /** Sends a message. @return True if it is sent already; otherwise on_written() is called later.
   */
  [[nodiscard]] virtual bool write(MessageBytes message) = 0;
  /** Continues reading after a pause. */
  virtual void resume_reading() = 0;
  /** Everything has been sent: closes the sending direction. */
  virtual void shut_down() = 0;
  /** What is known of the connection with the client. */
  virtual LinkMeasurement measure() { return measure_link(*socket()); }
  /** Bytes that were written and that the other end has not acknowledged. */
  virtual size_t unacknowledged() { return count_unacknowledged(*socket(), segment_bytes_); }
  /** The TCP socket; null: there is none, and measure() and unacknowledged() are overridden. */
  virtual Tcp::socket* socket() { return nullptr; }
  /** Closes the socket; operations in progress end with an error. */
  virtual void close_socket() = 0;

  ConnectionContext& context_;

 private:
  /** @param takes_long  The first message may be an image or a piece of audio. */
  void send_messages(bool takes_long);
  void send(MessageBytes message);
  void set_deadline(std::chrono::seconds time);
  void wait_for_deadline();
  void end_handshake();
  void finish(const std::string& why);

  asio::steady_timer pause_;
  asio::steady_timer deadline_timer_;
  /** Time at which the write in progress must be complete. The timer is not set again for every
   * message: when it expires it compares with this. */
  std::optional<asio::steady_timer::time_point> deadline_;
  bool is_deadline_timer_running_ = false;
  uint32_t id_ = 0;
  /** Of LinkMeasurement, as of the client's last message. */
  uint32_t segment_bytes_ = 0;
  HandshakeLimiter::Entry handshake_;
  bool is_in_handshake_ = false;
  bool is_flush_queued_ = false;
  bool is_long_queued_ = false;
  /** Of Outgoing. */
  bool measures_image_ = false;
  bool is_writing_ = false;
  bool is_shut_down_ = false;
  bool is_finished_ = false;
};

}  // namespace nao::gateway
