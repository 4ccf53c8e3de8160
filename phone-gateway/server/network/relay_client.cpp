#include "phone-gateway/server/network/relay_client.h"
//
#include <openssl/ssl.h>

#include <algorithm>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <filesystem>
#include <vector>

#include "common/error.h"
#include "common/logger.h"
#include "phone-gateway/secure_channel/hexadecimal.h"
#include "phone-gateway/secure_channel/invitations.h"
#include "phone-gateway/secure_channel/relay_target.h"
#include "phone-gateway/server/network/relayed_connection.h"

namespace nao::gateway {
namespace {

namespace websocket = beast::websocket;
using std::chrono::milliseconds;

constexpr std::chrono::seconds kDialTimeout{5};
/** The relay pings twice as often. */
constexpr std::chrono::seconds kRelaySilence{10};
/** Pauses between attempts. Chosen: a relay that was restarted has its robots again within 5 s. */
constexpr milliseconds kFirstPause{250};
constexpr milliseconds kLongestPause{2000};

double unix_seconds() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

struct RelayClient::Impl : std::enable_shared_from_this<RelayClient::Impl> {
  using Socket = websocket::stream<WebStream, false>;

  Impl(ConnectionContext& new_context, const std::string& new_address, const std::string& new_file)
      : context(new_context),
        address(parse_relay_address(new_address)),
        file(new_file),
        access(change_relay_access(
            new_file, [&](RelayAccess& changed_access) { changed_access.relay = new_address; })),
        tls(asio::ssl::context::tls_client),
        resolver(new_context.io),
        pause(new_context.io) {
    changed = std::filesystem::last_write_time(file);
  }

  void dial() {
    resolver.async_resolve(address.host, address.port,
                           [self = shared_from_this()](const error_code& error,
                                                       const Tcp::resolver::results_type& results) {
                             if (error) return self->fail(error.message());
                             self->connect(results);
                           });
  }

  void connect(const Tcp::resolver::results_type& results) {
    auto stream = std::make_shared<beast::tcp_stream>(context.io);
    stream->expires_after(kDialTimeout);
    stream->async_connect(results, [self = shared_from_this(), stream](
                                       const error_code& error, const Tcp::endpoint& endpoint) {
      if (error) return self->fail(error.message());
      self->relay = endpoint;
      prepare_socket(stream->socket(), "");
      WebStream secure(std::move(*stream), self->tls);
      self->socket = std::make_shared<Socket>(std::move(secure));
      self->shake_hands(self->socket);
    });
  }

  void shake_hands(const std::shared_ptr<Socket>& to) {
    to->next_layer().connect(
        address.host,
        Completion(
            [self = shared_from_this(), to](const error_code& error, size_t) {
              if (error) return self->fail("TLS: " + error.message());
              beast::get_lowest_layer(*to).expires_never();
              to->set_option(websocket::stream_base::timeout{kDialTimeout, kRelaySilence, true});
              to->read_message_max(2 * kTicketBytes);
              to->async_handshake(self->address.host,
                                  write_relay_target({RelayTarget::Kind::kRobot, self->access.key}),
                                  [self, to](const error_code& handshake_error) {
                                    if (handshake_error)
                                      return self->fail(handshake_error.message());
                                    self->read(to);
                                  });
            },
            context.io.get_executor()));
  }

  void read(const std::shared_ptr<Socket>& from) {
    from->async_read(buffer, [self = shared_from_this(), from](const error_code& error, size_t) {
      if (error == websocket::error::closed && !from->reason().reason.empty()) {
        return self->fail(from->reason().reason.c_str());
      }
      if (error) return self->fail(error.message());
      const std::string ticket(static_cast<const char*>(self->buffer.data().data()),
                               self->buffer.size());
      self->buffer.consume(self->buffer.size());
      // The first message tells that the relay has accepted the robot; it is no ticket.
      if (!std::exchange(self->is_connected, true)) {
        self->attempts = 0;
        self->last_fault.clear();
        logger::info("connected with the relay {}", self->access.relay);
      }
      if (from_hex(ticket, kTicketBytes)) self->serve(ticket);
      self->read(from);
    });
  }

  void serve(const std::string& ticket) {
    std::erase_if(phones, [](const auto& phone) { return phone.expired(); });
    phones.push_back(serve_relayed_phone(
        context, relay, address.host, ticket, [weak = weak_from_this()](std::string_view id) {
          const auto self = weak.lock();
          if (!self) return static_cast<const Invitation*>(nullptr);
          const Invitation* known = self->access.find(id, unix_seconds());
          if (known != nullptr) return known;
          // It may be newer than the last look at the file.
          self->read_changed_file();
          return self->access.find(id, unix_seconds());
        }));
  }

  void fail(const std::string& why) {
    if (is_ended) return;
    if (is_connected || why != last_fault) {
      logger::warn("no connection with the relay {}: {}; the local network works on", access.relay,
                   why);
    }
    last_fault = why;
    is_connected = false;
    buffer.clear();
    if (socket) beast::get_lowest_layer(*socket).close();
    socket.reset();
    pause.expires_after(std::min(kFirstPause * (1 << std::min(attempts++, 4)), kLongestPause));
    pause.async_wait([self = shared_from_this()](const error_code& error) {
      if (!error && !self->is_ended) self->dial();
    });
  }

  void read_changed_file() {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    if (!error && time != changed) {
      changed = time;
      try {
        access.invitations = load_relay_access(file).invitations;
      } catch (const Error& fault) {
        // Nobody is let in by a file that cannot be read.
        access.invitations.clear();
        logger::error("{}", fault.what());
      }
    }
  }

  void step() {
    read_changed_file();
    for (const auto& weak : phones) {
      if (const auto phone = weak.lock()) phone->check_invitation();
    }
  }

  void end() {
    is_ended = true;
    pause.cancel();
    resolver.cancel();
    if (socket) beast::get_lowest_layer(*socket).close();
  }

  ConnectionContext& context;
  RelayAddress address;
  std::filesystem::path file;
  std::filesystem::file_time_type changed;
  RelayAccess access;
  asio::ssl::context tls;
  Tcp::resolver resolver;
  asio::steady_timer pause;
  Tcp::endpoint relay;
  std::shared_ptr<Socket> socket;
  beast::flat_buffer buffer;
  std::vector<std::weak_ptr<RelayedPhone>> phones;
  std::string last_fault;
  int attempts = 0;
  bool is_connected = false;
  bool is_ended = false;
};

RelayClient::RelayClient(ConnectionContext& context, const std::string& address,
                         const std::string& file)
    : impl_(std::make_shared<Impl>(context, address, file)) {
  impl_->dial();
}

RelayClient::~RelayClient() {
  impl_->end();
}

void RelayClient::step() {
  impl_->step();
}

}  // namespace nao::gateway
