#include "tools/foxglove/protocol.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/json_text.h"
#include "common/json_writer.h"

namespace nao::foxglove {
namespace {

using Json = nlohmann::json;

// Operation codes of the server's binary messages.
constexpr char kMessageData = 1;
// Operation code of a client's binary message, and the bytes of its head: code and channel.
constexpr char kClientMessageData = 1;
constexpr size_t kClientMessageHead = 5;
constexpr char kFetchAssetResponse = 4;
// Status of a fetched asset.
constexpr char kAssetIsThere = 0;
constexpr char kAssetIsMissing = 1;
// Letters of a client's text that an answer repeats. Chosen: a line.
constexpr size_t kQuotedLetters = 80;

void append_little_endian(std::string& bytes, uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
}

/** A member that is an integer of 32 bits without sign. */
std::optional<uint32_t> find_number(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  const auto value = found->get<uint64_t>();
  if (value > std::numeric_limits<uint32_t>::max()) return std::nullopt;
  return static_cast<uint32_t>(value);
}

ClientRequest parse_subscribe(const Json& message) {
  const auto list = message.find("subscriptions");
  if (list == message.end() || !list->is_array()) {
    return Refused{"subscribe has no list \"subscriptions\"."};
  }
  Subscribe request;
  for (const Json& item : *list) {
    const auto id = item.is_object() ? find_number(item, "id") : std::nullopt;
    const auto channel = item.is_object() ? find_number(item, "channelId") : std::nullopt;
    if (!id || !channel) {
      return Refused{"An entry of \"subscriptions\" lacks the numbers \"id\" and \"channelId\"."};
    }
    request.entries.push_back({*id, *channel});
  }
  return request;
}

/** Reads a list of the numbers under which the client knows something. Those beyond 32 bits are
 * left out: nothing has them. @return false if it is not such a list. */
bool read_numbers(const Json& message, const char* key, std::vector<uint32_t>& numbers) {
  const auto list = message.find(key);
  if (list == message.end() || !list->is_array()) return false;
  for (const Json& item : *list) {
    if (!item.is_number_unsigned()) return false;
    const auto number = item.get<uint64_t>();
    if (number <= std::numeric_limits<uint32_t>::max()) {
      numbers.push_back(static_cast<uint32_t>(number));
    }
  }
  return true;
}

ClientRequest parse_unsubscribe(const Json& message) {
  Unsubscribe request;
  if (read_numbers(message, "subscriptionIds", request.ids)) return request;
  return Refused{"unsubscribe has no list of numbers \"subscriptionIds\"."};
}

ClientRequest parse_unadvertise(const Json& message) {
  Unadvertise request;
  if (read_numbers(message, "channelIds", request.ids)) return request;
  return Refused{"unadvertise has no list of numbers \"channelIds\"."};
}

/** A member that is a text; "" if there is none. */
std::string find_text(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || !found->is_string() ? "" : found->get<std::string>();
}

ClientRequest parse_advertise(const Json& message) {
  const auto list = message.find("channels");
  if (list == message.end() || !list->is_array()) {
    return Refused{"advertise has no list \"channels\"."};
  }
  Advertise request;
  for (const Json& item : *list) {
    const auto id = item.is_object() ? find_number(item, "id") : std::nullopt;
    const std::string topic = id ? find_text(item, "topic") : "";
    if (topic.empty()) {
      return Refused{"An entry of \"channels\" lacks the number \"id\" or the text \"topic\"."};
    }
    request.entries.push_back({*id, topic, find_text(item, "encoding")});
  }
  return request;
}

ClientRequest parse_fetch_asset(const Json& message) {
  const auto uri = message.find("uri");
  const auto request_id = find_number(message, "requestId");
  if (uri == message.end() || !uri->is_string() || !request_id) {
    return Refused{"fetchAsset lacks the text \"uri\" and the number \"requestId\"."};
  }
  return FetchAsset{uri->get<std::string>(), *request_id};
}

}  // namespace

std::optional<std::string> choose_subprotocol(std::string_view offered) {
  std::vector<std::string_view> names;
  while (!offered.empty()) {
    const size_t end = std::min(offered.find(','), offered.size());
    std::string_view name = offered.substr(0, end);
    while (!name.empty() && (name.front() == ' ' || name.front() == '\t')) name.remove_prefix(1);
    while (!name.empty() && (name.back() == ' ' || name.back() == '\t')) name.remove_suffix(1);
    names.push_back(name);
    offered.remove_prefix(std::min(end + 1, offered.size()));
  }
  for (const char* known : kSubprotocols) {
    if (std::find(names.begin(), names.end(), known) != names.end()) return known;
  }
  return std::nullopt;
}

ClientRequest parse_client_text(std::string_view text) {
  const auto parsed = try_parse_json(text);
  if (!parsed || !parsed->is_object()) return Refused{"The text is no JSON object."};
  const Json& message = *parsed;
  const auto op = message.find("op");
  if (op == message.end() || !op->is_string()) return Refused{"The message has no text \"op\"."};
  const auto& name = op->get_ref<const std::string&>();
  if (name == "subscribe") return parse_subscribe(message);
  if (name == "unsubscribe") return parse_unsubscribe(message);
  if (name == "fetchAsset") return parse_fetch_asset(message);
  if (name == "advertise") return parse_advertise(message);
  if (name == "unadvertise") return parse_unadvertise(message);
  return Refused{"This server does not support \"" + name.substr(0, kQuotedLetters) + "\"."};
}

std::variant<ClientMessage, Refused> parse_client_binary(std::string_view bytes) {
  if (bytes.size() < kClientMessageHead || bytes[0] != kClientMessageData) {
    return Refused{"The binary message is not a message of a channel."};
  }
  uint32_t channel = 0;
  for (size_t i = kClientMessageHead - 1; i > 0; --i) {
    channel = channel << 8 | static_cast<uint8_t>(bytes[i]);
  }
  return ClientMessage{channel, bytes.substr(kClientMessageHead)};
}

std::string server_info_text(const std::string& name, const std::string& session_id,
                             bool can_publish) {
  JsonWriter json;
  json.begin_object();
  json.add("op", "serverInfo");
  json.add("name", name);
  json.begin_array("capabilities");
  json.add("", "assets");
  if (can_publish) json.add("", "clientPublish");
  json.end();
  json.begin_array("supportedEncodings");
  if (can_publish) json.add("", "json");
  json.end();
  json.begin_object("metadata");
  json.end();
  json.add("sessionId", session_id);
  return json.take();
}

std::string advertise_text(const std::vector<const Channel*>& channels) {
  JsonWriter json;
  json.begin_object();
  json.add("op", "advertise");
  json.begin_array("channels");
  for (const Channel* channel : channels) {
    json.begin_object();
    json.add("id", int64_t{channel->id});
    json.add("topic", channel->topic);
    json.add("encoding", "json");
    json.add("schemaName", channel->schema_name);
    json.add("schema", channel->schema);
    json.add("schemaEncoding", "jsonschema");
    json.end();
  }
  return json.take();
}

std::string status_text(StatusLevel level, const std::string& message) {
  JsonWriter json;
  json.begin_object();
  json.add("op", "status");
  json.add("level", static_cast<int>(level));
  json.add("message", message);
  return json.take();
}

std::string message_header(uint32_t subscription, int64_t wall_utime) {
  std::string bytes(1, kMessageData);
  append_little_endian(bytes, subscription, 4);
  append_little_endian(bytes, static_cast<uint64_t>(std::max<int64_t>(0, wall_utime)) * 1000, 8);
  return bytes;
}

std::string asset_header(uint32_t request_id) {
  std::string bytes(1, kFetchAssetResponse);
  append_little_endian(bytes, request_id, 4);
  bytes += kAssetIsThere;
  append_little_endian(bytes, 0, 4);
  return bytes;
}

std::string asset_error(uint32_t request_id, const std::string& why) {
  std::string bytes(1, kFetchAssetResponse);
  append_little_endian(bytes, request_id, 4);
  bytes += kAssetIsMissing;
  append_little_endian(bytes, why.size(), 4);
  return bytes + why;
}

}  // namespace nao::foxglove
