#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tools/foxglove/client_publisher.h"
#include "tools/foxglove/outbox.h"
#include "tools/foxglove/protocol.h"

namespace nao::foxglove {

/** Limits of clients. */
struct ClientLimits {
  size_t max_clients = 16;
  /** Size of all messages that wait for one client. All meshes of a robot, some MB, must fit. */
  size_t max_queued_bytes = 32u << 20;
};

/** Counters since the start. */
struct ServerCounters {
  int64_t num_clients = 0;
  int64_t num_sent = 0;
  int64_t num_sent_bytes = 0;
  /** Messages of channels that slow clients did not receive. */
  int64_t num_dropped = 0;
  /** Requests that were not fulfilled. */
  int64_t num_refused = 0;
};

/** The server without sockets, bus and clock: channels, clients, their subscriptions, and the
 * messages that wait for them. */
class ServerCore {
 public:
  using Assets = std::function<std::shared_ptr<const std::string>(std::string_view uri)>;

  /** @param name  Shown by clients. @param session_id  Differs from one run to the next.
   * @param assets  Reads a file that a client requests; null: it may not. */
  ServerCore(std::string name, std::string session_id, ClientLimits limits, Assets assets);
  ServerCore(const ServerCore&) = delete;
  ServerCore& operator=(const ServerCore&) = delete;

  /** Called when a client subscribes to a channel, to send it the last message. */
  void on_subscribe(std::function<void(uint32_t client, uint32_t channel)> handler) {
    on_subscribe_ = std::move(handler);
  }

  /** Lets clients publish; without this, the server is read-only.
   * @param publisher  Must outlive this. */
  void allow_publishing(ClientPublisher& publisher) { publisher_ = &publisher; }

  // Channels.

  /** Adds a channel and tells all clients. @return Its number. */
  uint32_t add_channel(const std::string& topic, const std::string& schema_name,
                       const std::string& schema);
  bool has_subscribers(uint32_t channel) const { return num_subscribers_.at(channel) > 0; }
  /** Sends a message to all subscribers of a channel. @param wall_utime  Time of reception. */
  void publish(uint32_t channel, int64_t wall_utime, std::string content);
  /** Sends it to one of them. */
  void publish_to(uint32_t client, uint32_t channel, int64_t wall_utime, std::string content);

  // Clients.

  /** @param wake  Called when a message waits: next_message() then has one.
   * @return Number of the client; 0 if there are too many. */
  uint32_t open(std::function<void()> wake);
  void receive_text(uint32_t client, std::string_view text);
  void receive_binary(uint32_t client, std::string_view bytes);
  std::optional<OutgoingMessage> next_message(uint32_t client);
  /** The client must be disconnected: its answers do not fit into its queue. */
  bool must_close(uint32_t client) const { return clients_.at(client).must_close; }
  void close(uint32_t client);

  size_t num_clients() const { return clients_.size(); }
  const ServerCounters& counters() const { return counters_; }

 private:
  struct Client {
    std::function<void()> wake;
    Outbox outbox;
    /** Channel of each subscription, and the reverse. */
    std::map<uint32_t, uint32_t> channels;
    std::map<uint32_t, uint32_t> subscriptions;
    /** What the client publishes: topics by its numbers. */
    std::map<uint32_t, std::string> topics;
    bool must_close = false;
  };

  void answer(Client& client, OutgoingMessage message);
  void answer_text(Client& client, std::string text);
  void refuse(Client& client, const std::string& why);
  void take(uint32_t id, const Subscribe& request);
  void take(uint32_t id, const Unsubscribe& request);
  void take(uint32_t id, const FetchAsset& request);
  void take(uint32_t id, const Advertise& request);
  void take(uint32_t id, const Unadvertise& request);
  void take(uint32_t id, const ClientMessage& message);
  void take(uint32_t id, const Refused& refused);
  void send(Client& client, uint32_t channel, int64_t wall_utime,
            const std::shared_ptr<const std::string>& content);
  void unsubscribe(Client& client, std::map<uint32_t, uint32_t>::iterator subscription);

  std::string name_;
  std::string session_id_;
  ClientLimits limits_;
  Assets assets_;
  ClientPublisher* publisher_ = nullptr;
  std::function<void(uint32_t, uint32_t)> on_subscribe_;
  /** By number. */
  std::map<uint32_t, Channel> channels_;
  std::map<uint32_t, int> num_subscribers_;
  std::map<uint32_t, Client> clients_;
  uint32_t last_client_ = 0;
  ServerCounters counters_;
};

}  // namespace nao::foxglove
