#pragma once

#include "phone-gateway/relay/relay_socket.h"
//
#include <array>
#include <functional>
#include <memory>
#include <utility>

namespace nao::relay {

/** A phone pings, and the gateway answers, once a second: who is silent for this time has gone. */
inline constexpr std::chrono::seconds kSilence{15};
/** Bytes that are read at once. Chosen: a state in one piece; 1,000 phones need 4 MB. */
inline constexpr size_t kPieceBytes = 2048;
/** Bytes that the kernel keeps of what a gateway sends. Chosen: two images; the older ones wait at
 * the gateway, which then sends fewer. */
inline constexpr int kReceivedBytes = 32768;
/** A phone, and the connection of its robot's gateway once that has come. */
class Splice : public std::enable_shared_from_this<Splice> {
 public:
  Splice(WebStream phone, std::function<void()> ended)
      : phone_{WebSocket(std::move(phone)), {}, false, false}, ended_(std::move(ended)) {}
  ~Splice() { ended_(); }

  void accept_phone(WebRequest request, std::function<void()> then) {
    accept(phone_, std::move(request), std::move(then));
  }
  void accept_gateway(WebStream gateway, WebRequest request) {
    error_code ignored;
    gateway.next_layer().socket().set_option(asio::socket_base::receive_buffer_size(kReceivedBytes),
                                             ignored);
    gateway_ = std::make_unique<End>(End{WebSocket(std::move(gateway)), {}, false, false});
    accept(*gateway_, std::move(request), [] {});
  }
  void close() {
    for (End* end : {&phone_, gateway_.get()}) {
      if (end != nullptr) beast::get_lowest_layer(end->socket).close();
    }
  }

 private:
  struct End {
    WebSocket socket;
    std::array<char, kPieceBytes> bytes;
    bool is_open;
    bool is_closing;
  };

  void accept(End& end, WebRequest request, std::function<void()> then) {
    prepare(end.socket, kSilence, false);
    const auto kept = std::make_shared<WebRequest>(std::move(request));
    end.socket.async_accept(*kept, [self = shared_from_this(), &end, kept,
                                    then = std::move(then)](const error_code& error) {
      if (error) return self->close();
      end.is_open = true;
      then();
      // What the phone sends before waits in its kernel.
      if (self->gateway_ && self->gateway_->is_open && self->phone_.is_open) {
        self->pass(self->phone_, *self->gateway_);
        self->pass(*self->gateway_, self->phone_);
      }
    });
  }

  void pass(End& from, End& to) {
    from.socket.async_read_some(
        asio::buffer(from.bytes),
        [self = shared_from_this(), &from, &to](const error_code& error, size_t size) {
          if (error) return self->end(from, to);
          to.socket.async_write_some(from.socket.is_message_done(), asio::buffer(from.bytes, size),
                                     [self, &from, &to](const error_code& write_error, size_t) {
                                       if (write_error) return self->end(to, from);
                                       self->pass(from, to);
                                     });
        });
  }

  /** One end has gone: the other one gets what was read, then the end. */
  void end(End& gone, End& other) {
    beast::get_lowest_layer(gone.socket).close();
    if (std::exchange(other.is_closing, true) || gone.is_closing) return;
    other.socket.async_close(websocket::close_code::normal,
                             [self = shared_from_this(), &other](const error_code&) {
                               beast::get_lowest_layer(other.socket).close();
                             });
  }

  End phone_;
  std::unique_ptr<End> gateway_;
  std::function<void()> ended_;
};

}  // namespace nao::relay
