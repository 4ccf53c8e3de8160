#pragma once

#include <cstddef>

namespace nao {

/** What the gateway allows, and how long it waits. Defaults are the protocol's promises; see
 * ../PROTOCOL.md. Times in seconds. */
struct GatewayLimits {
  /** Clients connected at once. */
  int max_clients = 32;
  /** Clients connected at once from one address other than this host's. */
  int max_clients_per_address = 8;
  /** Requests a second of one client, also the size of its first burst. */
  double max_request_rate = 100;
  /** Requests of one connection that are no Request, before it is closed. */
  int max_malformed_requests = 10;
  /** Answers and notices that wait for a slow client: reading from it pauses at the first figure,
   * its connection closes at the second. */
  size_t congested_outbox_messages = 32;
  size_t max_outbox_messages = 256;
  /** Wrong tokens from one address before it has to wait for `wrong_token_pause`. */
  int max_wrong_tokens = 5;
  double wrong_token_pause = 10;

  /** From accepting a connection to its Connect. */
  double handshake_time = 5;
  /** Longest silence of a client. */
  double silence_time = 5;
  /** From the last WalkTurn to the end of the walk. */
  double walk_stale_time = 0.5;
  /** Between two repetitions of a walk command or of an unanswered command on the bus. */
  double repeat_period = 0.1;
  /** How long a command is repeated before nao-motion counts as not answering. */
  double answer_time = 1.5;
  /** From the driver's last command to the moment when somebody else may take control. */
  double lease_idle_time = 10;
  /** How long a polling client counts as watching after its last GetState with image. */
  double poll_watch_time = 2;
  /** Longest silence of nao-motion, of the robot, of the camera's images while somebody watches,
   * and of the camera's DAEMON_STATUS, which comes twice a second, before the part counts as gone:
   * phones are told within 2 s. */
  double motion_silence_time = 1.0;
  double robot_silence_time = 1.0;
  double image_silence_time = 1.5;
  double camera_status_silence_time = 1.8;

  /** States and images a second that a client may subscribe to. */
  double max_state_rate = 60;
  double max_image_rate = 30;
};

}  // namespace nao
