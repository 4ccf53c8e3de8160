#pragma once

#include <cstddef>

namespace nao::gateway {

/** Limits and timeouts of the gateway. The defaults are those that PROTOCOL.md promises to clients.
 * Times in s, rates in 1/s. One struct has all of them, so that a test can change any. */
struct GatewayLimits {
  /** Connected clients. */
  int max_clients = 128;
  /** Connected clients of one address that is not this host's. */
  int max_clients_per_address = 32;
  /** Requests of one client; also the size of its first burst. */
  double max_request_rate = 100;
  /** Messages of one connection that are no Request; one more closes it. */
  int max_malformed_requests = 10;
  /** Responses and notices queued for a slow client: above the first number the gateway pauses
   * reading its requests, above the second one it closes the connection. */
  size_t congested_outbox_messages = 32;
  size_t max_outbox_messages = 256;
  /** Wrong tokens of one address, after which it is refused for `wrong_token_pause`. */
  int max_wrong_tokens = 5;
  double wrong_token_pause = 10;

  /** From accepting a connection to its Connect. */
  double connect_timeout = 5;
  /** From a client's last request to closing its connection. */
  double silence_timeout = 5;
  /** From the last WalkTurn to velocity zero, stepping in place. nao-motion ends a walk after the
   * same time without commands. */
  double walk_timeout = 0.5;
  /** From the last WalkTurn to the end of the walk. Chosen: a phone that changes its access point
   * is silent for 0.8 s, and the robot goes on without the last and first steps of a walk. */
  double walk_end_timeout = 1.0;
  /** Age of a motion command above which it is not obeyed (RequestAge). Chosen: below walk_timeout,
   * so that nobody walks after the controls were released. */
  double max_command_age = 0.4;
  /** Round-trip times up to which a client may walk at full speed, and at which not at all; between
   * them the velocity falls in proportion. Chosen. */
  double full_speed_round_trip = 0.15;
  double max_round_trip = 1.0;
  /** From a driver's last request of any kind to the end of a behavior that it has begun: two of
   * its pings may be late. */
  double play_timeout = 2.5;
  /** Between two transmissions of a play command that was accepted: two may be lost within the 2 s
   * after which nao-play ends the behavior. */
  double play_period = 0.5;
  /** From the driver's last command to the moment when another client may take control. */
  double lease_idle_timeout = 10;
  /** From a GetState with image to the end of the image request that it stands for. */
  double poll_timeout = 2;
  /** Silence after which a component counts as unavailable: of nao-motion, of the robot, of the
   * camera's images while a client requests them, and of the camera's DAEMON_STATUS. Chosen so that
   * clients are notified within 2 s; the status arrives every 0.5 s, so that two may be lost. */
  double motion_timeout = 1.0;
  double robot_timeout = 1.0;
  double image_timeout = 1.5;
  double camera_status_timeout = 1.8;
  /** Timeout of nao-motion-files, which lists its motions once a second: three may be lost. */
  double motion_files_timeout = 3.5;
  /** Timeout of nao-sim's DAEMON_STATUS, which says that the robot is simulated. */
  double simulator_timeout = 3.5;

  /** Taught motions that a client may have under way. */
  int max_motion_requests = 4;
  /** Between two transmissions of an unanswered command about motions, which may be long. */
  double motion_file_repeat_period = 1.0;
  /** From a request about motions to reporting that it is not answered: a long motion is simulated
   * for half a minute, and a motion of another client before it. */
  double motion_file_timeout = 120;

  /** States and images that a client may subscribe to. */
  double max_state_rate = 60;
  double max_image_rate = 30;
};

}  // namespace nao::gateway
