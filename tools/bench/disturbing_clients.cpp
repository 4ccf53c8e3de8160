#include "tools/bench/disturbing_clients.h"

#include <sys/socket.h>

#include <array>
#include <chrono>

#include "phone-gateway/protocol/framing.h"

namespace nao::bench {
namespace {

// Chosen: 10000 requests and 1000 bytes per second, sent and read in turns of 10 ms.
constexpr auto kTurn = std::chrono::milliseconds(10);
constexpr int kTurnsPerSecond = 100;
constexpr int kFloodPerTurn = 10000 / kTurnsPerSecond;
constexpr size_t kSlowBytesPerTurn = 1000 / kTurnsPerSecond;
constexpr size_t kMaxFloodBytes = 1 << 16;

naoremote::Request ping() {
  naoremote::Request request;
  request.mutable_ping();
  return request;
}

/** Connects and subscribes at the highest rates. */
std::unique_ptr<WireClient> connect_subscriber(uint16_t tcp_port) {
  auto client = connect_tcp(tcp_port);
  naoremote::Request request;
  request.mutable_connect()->set_protocol_version(1);
  client->send(request);
  request.mutable_subscribe()->set_state_rate(60);
  request.mutable_subscribe()->set_image_rate(30);
  client->send(request);
  return client;
}

}  // namespace

DisturbingClients::DisturbingClients(uint16_t tcp_port)
    : stalled_(connect_subscriber(tcp_port)),
      slow_(connect_subscriber(tcp_port)),
      flooding_(connect_subscriber(tcp_port)),
      thread_([this] { run(); }) {}

DisturbingClients::~DisturbingClients() {
  is_ending_ = true;
  thread_.join();
}

void DisturbingClients::run() {
  std::array<char, kSlowBytesPerTurn> bytes;
  for (int turn = 0; !is_ending_; ++turn) {
    std::this_thread::sleep_for(kTurn);
    if (turn % kTurnsPerSecond == 0) {
      // Without a request in 5 s the gateway would close them.
      stalled_->send(ping());
      slow_->send(ping());
    }
    (void)recv(slow_->descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    flood();
  }
}

void DisturbingClients::flood() {
  std::array<char, 65536> bytes;
  (void)recv(flooding_->descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  for (int i = 0; i < kFloodPerTurn && flood_.size() < kMaxFloodBytes; ++i) {
    flood_ += frame(ping().SerializeAsString());
  }
  const ssize_t sent =
      ::send(flooding_->descriptor(), flood_.data(), flood_.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent > 0) flood_.erase(0, static_cast<size_t>(sent));
}

}  // namespace nao::bench
