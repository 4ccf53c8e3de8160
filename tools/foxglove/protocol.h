#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/** Messages of the Foxglove WebSocket protocol that this server takes and sends.
 *
 * Source: https://github.com/foxglove/ws-protocol, docs/spec.md. Text messages are JSON objects
 * whose "op" names the kind, binary messages begin with a byte that does; numbers are
 * little-endian. */
namespace nao::foxglove {

/** Names under which WebSockets agree on the protocol, the preferred one first. The messages are
 * the same under both; current programs offer the first only, older ones the second only. */
inline constexpr const char* kSubprotocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/** The subprotocol to answer with. @param offered  Sec-WebSocket-Protocol header: names with commas
 * between them. @return Nothing if none of them is known. */
std::optional<std::string> choose_subprotocol(std::string_view offered);

/** A channel as clients see it. */
struct Channel {
  uint32_t id = 0;
  /** Such as "NAO_ROBOT_STATE". */
  std::string topic;
  /** Such as "naolcm.robot_state_t". */
  std::string schema_name;
  /** JSON Schema of the messages, which are JSON. */
  std::string schema;
};

// What clients may request.

struct Subscribe {
  struct Entry {
    /** The client's number for the subscription. */
    uint32_t id = 0;
    uint32_t channel = 0;
  };
  std::vector<Entry> entries;
};

struct Unsubscribe {
  std::vector<uint32_t> ids;
};

struct FetchAsset {
  std::string uri;
  uint32_t request_id = 0;
};

/** Channels that the client will publish on. */
struct Advertise {
  struct Entry {
    /** The client's number for its channel. */
    uint32_t id = 0;
    std::string topic;
    /** Encoding of the messages; "json" is understood. */
    std::string encoding;
  };
  std::vector<Entry> entries;
};

struct Unadvertise {
  std::vector<uint32_t> ids;
};

/** A message that the client publishes. */
struct ClientMessage {
  /** The client's number of an advertised channel. */
  uint32_t channel = 0;
  std::string_view content;
};

/** A request that is not fulfilled, with the reason as a sentence. */
struct Refused {
  std::string why;
};

using ClientRequest =
    std::variant<Subscribe, Unsubscribe, FetchAsset, Advertise, Unadvertise, Refused>;

/** Reads a text message of a client; any bytes are answered. */
ClientRequest parse_client_text(std::string_view text);

/** Reads a binary message of a client: one that it publishes; any bytes are answered. */
std::variant<ClientMessage, Refused> parse_client_binary(std::string_view bytes);

enum class StatusLevel { kInfo = 0, kWarning = 1, kError = 2 };

// Texts that the server sends.

/** @param session_id  Differs from one run of the server to the next.
 * @param can_publish  Whether clients may publish. */
std::string server_info_text(const std::string& name, const std::string& session_id,
                             bool can_publish);
std::string advertise_text(const std::vector<const Channel*>& channels);
std::string status_text(StatusLevel level, const std::string& message);

// Binary messages that the server sends.

/** Beginning of a message of a channel; the content follows.
 * @param wall_utime  Time of reception from the bus, microseconds since 1970. */
std::string message_header(uint32_t subscription, int64_t wall_utime);
/** Beginning of an asset; its bytes follow. */
std::string asset_header(uint32_t request_id);
std::string asset_error(uint32_t request_id, const std::string& why);

}  // namespace nao::foxglove
