#include "tools/foxglove/server_core.h"

#include <utility>

namespace nao::foxglove {
namespace {

// Channels that one client may advertise. Chosen: more than there are kinds of commands.
constexpr size_t kMaxAdvertisedTopics = 100;
constexpr const char* kReadOnly =
    "This server is read-only; nao-foxglove --allow-commands lets clients publish.";

}  // namespace

ServerCore::ServerCore(std::string name, std::string session_id, ClientLimits limits, Assets assets)
    : name_(std::move(name)),
      session_id_(std::move(session_id)),
      limits_(limits),
      assets_(std::move(assets)) {}

uint32_t ServerCore::add_channel(const std::string& topic, const std::string& schema_name,
                                 const std::string& schema) {
  const auto id = static_cast<uint32_t>(channels_.size() + 1);
  const Channel& channel = channels_[id] = {id, topic, schema_name, schema};
  num_subscribers_[id] = 0;
  const std::string text = advertise_text({&channel});
  for (auto& [number, client] : clients_) answer_text(client, text);
  return id;
}

void ServerCore::publish(uint32_t channel, int64_t wall_utime, std::string content) {
  const auto shared = std::make_shared<const std::string>(std::move(content));
  for (auto& [number, client] : clients_) send(client, channel, wall_utime, shared);
}

void ServerCore::publish_to(uint32_t client, uint32_t channel, int64_t wall_utime,
                            std::string content) {
  send(clients_.at(client), channel, wall_utime,
       std::make_shared<const std::string>(std::move(content)));
}

void ServerCore::send(Client& client, uint32_t channel, int64_t wall_utime,
                      const std::shared_ptr<const std::string>& content) {
  const auto subscription = client.subscriptions.find(channel);
  if (subscription == client.subscriptions.end() || client.must_close) return;
  const int64_t num_dropped = client.outbox.num_dropped();
  client.outbox.add(channel, {false, message_header(subscription->second, wall_utime), content});
  counters_.num_dropped += client.outbox.num_dropped() - num_dropped;
  client.wake();
}

uint32_t ServerCore::open(std::function<void()> wake) {
  if (clients_.size() >= limits_.max_clients) return 0;
  const uint32_t id = ++last_client_;
  ++counters_.num_clients;
  Client& client =
      clients_
          .try_emplace(id, Client{std::move(wake), Outbox(limits_.max_queued_bytes), {}, {}, {}})
          .first->second;
  answer_text(client, server_info_text(name_, session_id_, publisher_ != nullptr));
  std::vector<const Channel*> channels;
  for (const auto& [number, channel] : channels_) channels.push_back(&channel);
  answer_text(client, advertise_text(channels));
  return id;
}

void ServerCore::close(uint32_t id) {
  Client& client = clients_.at(id);
  for (const auto& [subscription, channel] : client.channels) --num_subscribers_[channel];
  clients_.erase(id);
}

std::optional<OutgoingMessage> ServerCore::next_message(uint32_t id) {
  auto message = clients_.at(id).outbox.next();
  if (message) {
    ++counters_.num_sent;
    counters_.num_sent_bytes += static_cast<int64_t>(message->size());
  }
  return message;
}

void ServerCore::receive_text(uint32_t id, std::string_view text) {
  std::visit([&](const auto& request) { take(id, request); }, parse_client_text(text));
}

void ServerCore::receive_binary(uint32_t id, std::string_view bytes) {
  std::visit([&](const auto& request) { take(id, request); }, parse_client_binary(bytes));
}

void ServerCore::take(uint32_t id, const Subscribe& request) {
  Client& client = clients_.at(id);
  for (const auto& [subscription, channel] : request.entries) {
    if (!channels_.contains(channel)) {
      refuse(client, "There is no channel " + std::to_string(channel) + ".");
    } else if (client.channels.contains(subscription)) {
      refuse(client, "The subscription id " + std::to_string(subscription) + " is in use.");
    } else if (client.subscriptions.contains(channel)) {
      refuse(client, "Channel " + std::to_string(channel) + " is subscribed already.");
    } else {
      client.channels[subscription] = channel;
      client.subscriptions[channel] = subscription;
      ++num_subscribers_[channel];
      if (on_subscribe_) on_subscribe_(id, channel);
    }
  }
}

void ServerCore::take(uint32_t id, const Unsubscribe& request) {
  Client& client = clients_.at(id);
  for (const uint32_t number : request.ids) {
    const auto subscription = client.channels.find(number);
    if (subscription == client.channels.end()) {
      refuse(client, "There is no subscription " + std::to_string(number) + ".");
    } else {
      unsubscribe(client, subscription);
    }
  }
}

void ServerCore::unsubscribe(Client& client, std::map<uint32_t, uint32_t>::iterator subscription) {
  const uint32_t channel = subscription->second;
  client.outbox.forget(channel);
  client.subscriptions.erase(channel);
  client.channels.erase(subscription);
  --num_subscribers_[channel];
}

void ServerCore::take(uint32_t id, const FetchAsset& request) {
  Client& client = clients_.at(id);
  auto content = assets_(request.uri);
  if (content) {
    answer(client, {false, asset_header(request.request_id), std::move(content)});
  } else {
    ++counters_.num_refused;
    answer(client, {false,
                    asset_error(request.request_id,
                                "There is no such file; the robot is package://robot/robot.urdf."),
                    nullptr});
  }
}

void ServerCore::take(uint32_t id, const Advertise& request) {
  Client& client = clients_.at(id);
  if (publisher_ == nullptr) return refuse(client, kReadOnly);
  for (const Advertise::Entry& entry : request.entries) {
    const std::string fault = publisher_->check(entry.topic, entry.encoding);
    if (!fault.empty()) {
      refuse(client, fault);
    } else if (client.topics.contains(entry.id)) {
      refuse(client, "The channel id " + std::to_string(entry.id) + " is in use.");
    } else if (client.topics.size() >= kMaxAdvertisedTopics) {
      refuse(client, "Too many channels are advertised.");
    } else {
      client.topics[entry.id] = entry.topic;
    }
  }
}

void ServerCore::take(uint32_t id, const Unadvertise& request) {
  Client& client = clients_.at(id);
  for (const uint32_t number : request.ids) {
    if (client.topics.erase(number) == 0) {
      refuse(client, "There is no advertised channel " + std::to_string(number) + ".");
    }
  }
}

void ServerCore::take(uint32_t id, const ClientMessage& message) {
  Client& client = clients_.at(id);
  if (publisher_ == nullptr) return refuse(client, kReadOnly);
  const auto topic = client.topics.find(message.channel);
  if (topic == client.topics.end()) {
    return refuse(client,
                  "There is no advertised channel " + std::to_string(message.channel) + ".");
  }
  const std::string fault = publisher_->publish(id, topic->second, message.content);
  if (!fault.empty()) refuse(client, topic->second + ": " + fault);
}

void ServerCore::take(uint32_t id, const Refused& refused) {
  refuse(clients_.at(id), refused.why);
}

void ServerCore::refuse(Client& client, const std::string& why) {
  ++counters_.num_refused;
  answer_text(client, status_text(StatusLevel::kError, why));
}

void ServerCore::answer_text(Client& client, std::string text) {
  answer(client, {true, std::move(text), nullptr});
}

void ServerCore::answer(Client& client, OutgoingMessage message) {
  if (client.must_close) return;
  client.must_close = !client.outbox.add_answer(std::move(message));
  client.wake();
}

}  // namespace nao::foxglove
