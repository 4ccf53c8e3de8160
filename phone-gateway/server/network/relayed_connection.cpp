#include "phone-gateway/server/network/relayed_connection.h"
//
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>
#include <utility>

#include "common/logger.h"
#include "common/wall_clock.h"
#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/secure_channel/hexadecimal.h"
#include "phone-gateway/secure_channel/relay_target.h"
#include "phone-gateway/secure_channel/secure_channel.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/network/client_connection.h"
#include "phone-gateway/server/network/round_trip.h"

namespace nao::gateway {
namespace {

namespace websocket = beast::websocket;

/** Time for connecting and for the handshake, as for Connect. */
constexpr std::chrono::seconds kFetchTimeout{5};
/** A phone is silent for 5 s at most (PROTOCOL.md, 6); the relay may be gone without a word. */
constexpr std::chrono::seconds kPhoneSilence{15};
class RelayedConnection : public ClientConnection, public RelayedPhone {
 public:
  RelayedConnection(ConnectionContext& context, FindInvitation find_invitation)
      : ClientConnection(context),
        socket_(beast::tcp_stream(context.io)),
        find_invitation_(std::move(find_invitation)) {}

  void start(const Tcp::endpoint& relay, const std::string& host, const std::string& ticket) {
    beast::tcp_stream& stream = beast::get_lowest_layer(socket_);
    stream.expires_after(kFetchTimeout);
    stream.async_connect(relay, [self = self(), host, ticket](const error_code& error) {
      if (error) return self->fail(error.message());
      beast::tcp_stream& connected = beast::get_lowest_layer(self->socket_);
      connected.expires_never();
      prepare_socket(connected.socket(), "");
      self->socket_.set_option(
          websocket::stream_base::timeout{kFetchTimeout, kPhoneSilence, false});
      self->socket_.read_message_max(kMaxRequestBytes + kFrameOverheadBytes);
      self->socket_.auto_fragment(false);
      self->socket_.binary(true);
      self->socket_.async_handshake(host, write_relay_target({RelayTarget::Kind::kTicket, ticket}),
                                    [self](const error_code& handshake_error) {
                                      if (handshake_error)
                                        return self->fail(handshake_error.message());
                                      self->read();
                                    });
    });
  }

  void check_invitation() override {
    if (is_open_ && !is_closing() && find_invitation_(invitation_) == nullptr) {
      reject(gateway_reason("invitation-ended"));
    }
  }

 private:
  std::shared_ptr<RelayedConnection> self() {
    return std::static_pointer_cast<RelayedConnection>(ClientConnection::shared_from_this());
  }

  static void fail(const std::string& why) { logger::info("phone over the relay: {}", why); }

  void read() {
    socket_.async_read(buffer_, [self = self()](const error_code& error, size_t) {
      if (error) {
        self->abort(error == websocket::error::closed ? "closed by the client" : error.message());
        return;
      }
      const std::string message(static_cast<const char*>(self->buffer_.data().data()),
                                self->buffer_.size());
      self->buffer_.consume(self->buffer_.size());
      if (self->channel_) {
        self->on_frame(message);
      } else {
        self->on_hello(message);
      }
    });
  }

  void on_hello(const std::string& hello) {
    const auto id = hello_invitation(hello);
    const Invitation* invitation = id ? find_invitation_(*id) : nullptr;
    std::optional<AnsweredHello> answered;
    if (invitation != nullptr) answered = answer_hello(EphemeralKey(), hello, invitation->secret);
    if (!answered) {
      context_.note_refusal("relay", "The invitation has ended, or there is none.");
      naoremote::ServerMessage message;
      message.mutable_notice()->set_kind(naoremote::Notice::CLOSING);
      write_reason(gateway_reason("invitation-ended"), *message.mutable_notice());
      // Not encrypted: no secret is shared.
      frame_ = std::string(1, '\0') + message.SerializeAsString();
      socket_.async_write(asio::buffer(frame_), [self = self()](const error_code&, size_t) {
        self->socket_.async_close(websocket::close_code::policy_error,
                                  [self](const error_code&) {});
      });
      return;
    }
    invitation_ = *id;
    role_ = invitation->role;
    channel_.emplace(std::move(answered->channel));
    round_trip_.sent(0, monotonic_seconds());
    frame_ = std::move(answered->answer);
    socket_.async_write(asio::buffer(frame_), [self = self()](const error_code& error, size_t) {
      if (!error) self->read();
    });
  }

  void on_frame(const std::string& frame) {
    OpenedFrame opened = channel_->open(frame);
    if (!is_open_) {
      // Only now it is known that the phone has the secret.
      if (opened.fault != FrameFault::kNone) return refuse_first(describe(opened.fault));
      is_open_ = true;
      open({"invitation " + to_hex(invitation_), "relay", false, true,
            role_ == Invitation::Role::kWatch, role_ == Invitation::Role::kOperate});
    }
    bool may_read = true;
    if (!is_closing()) {
      if (opened.fault != FrameFault::kNone) {
        reject(gateway_reason("relay-message-refused", {describe(opened.fault)}));
      } else if (find_invitation_(invitation_) == nullptr) {
        reject(gateway_reason("invitation-ended"));
      } else {
        round_trip_.acknowledged(opened.num_received_by_other, monotonic_seconds());
        may_read = receive(opened.text);
      }
    }
    if (may_read) read();
  }

  void refuse_first(const char* why) {
    context_.note_refusal("invitation " + to_hex(invitation_), why);
    socket_.async_close(websocket::close_code::policy_error, [self = self()](const error_code&) {});
  }

  void resume_reading() override { read(); }

  bool write(MessageBytes message) override {
    round_trip_.sent(channel_->num_sealed(), monotonic_seconds());
    frame_ = channel_->seal(*message);
    socket_.async_write(asio::buffer(frame_), [self = self()](const error_code& error, size_t) {
      self->on_written(error.failed());
    });
    return false;
  }

  void shut_down() override {
    socket_.async_close(websocket::close_code::policy_error, [self = self()](const error_code&) {
      self->abort("closed by the gateway");
    });
  }

  LinkMeasurement measure() override {
    LinkMeasurement link = measure_link(*socket());
    link.mean = round_trip_.mean();
    link.least = round_trip_.least();
    return link;
  }

  Tcp::socket* socket() override { return &beast::get_lowest_layer(socket_).socket(); }

  void close_socket() override { beast::get_lowest_layer(socket_).close(); }

  websocket::stream<beast::tcp_stream, false> socket_;
  FindInvitation find_invitation_;
  beast::flat_buffer buffer_;
  std::optional<SecureChannel> channel_;
  std::string invitation_;
  Invitation::Role role_ = Invitation::Role::kWatch;
  /** The phone has proved that it has the secret. */
  bool is_open_ = false;
  RoundTrip round_trip_;
  std::string frame_;
};

}  // namespace

std::weak_ptr<RelayedPhone> serve_relayed_phone(ConnectionContext& context,
                                                const Tcp::endpoint& relay, const std::string& host,
                                                const std::string& ticket,
                                                FindInvitation find_invitation) {
  const auto connection = std::make_shared<RelayedConnection>(context, std::move(find_invitation));
  connection->start(relay, host, ticket);
  return connection;
}

}  // namespace nao::gateway
