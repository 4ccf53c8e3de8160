#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "phone-gateway/server/core/gateway_robot.h"

namespace nao::gateway {

/** Team and number of a robot in a match. */
struct PlayerLabel {
  std::string robot;
  /** 0 or 1. */
  uint32_t team = 0;
  /** 1 or more. */
  uint32_t number = 0;
};

/** The robots of the gateway, which of them each client watches, and the list of them that clients
 * see. Every change of the list is sent to all clients, unless there is only one robot. */
class Robots {
 public:
  /** @param setups  At least one, with different names. */
  Robots(const GatewayLimits& limits, Sessions& sessions, const GatewayIdentity& identity,
         std::vector<RobotSetup> setups);

  size_t size() const { return robots_.size(); }
  GatewayRobot& at(size_t index) { return *robots_[index]; }
  const GatewayRobot& at(size_t index) const { return *robots_[index]; }
  /** The robot that a client watches. */
  GatewayRobot& of(const ClientSession& session) { return at(session.robot); }

  /** Index of the robot of a name; nothing if there is none. */
  std::optional<size_t> find(const std::string& name) const;
  /** Index of the robot for a client that names none: the first one that answers and that no client
   * drives, otherwise the first. */
  size_t choose() const;
  /** Why a request that names an unknown robot is refused. */
  Refusal refuse_unknown(const std::string& name) const;

  /** Teams and numbers, of a match or from the command line. Robots that are not listed have none.
   */
  void set_players(std::vector<PlayerLabel> players) { players_ = std::move(players); }

  /** A client watches another robot from now on: its control of the robot before ends, and it is
   * told with a notice. Nothing happens if it watches that robot already. */
  void change(ClientSession& session, size_t robot, double now);

  /** The list that clients see; empty if there is only one robot. */
  naoremote::RobotList list() const;

  /** The images that the camera program of a robot must send: what the robot's clients request, and
   * from the first one the overview for the clients of all robots. */
  std::vector<CameraRequest> camera_requests(size_t robot, double now) const;
  /** An image that the camera program of a robot sent. */
  void add_image(size_t robot, CachedImage image, double now);

  /** Steps every robot, and sends the list if it has changed. */
  void step(double now);

 private:
  Sessions& sessions_;
  // A GatewayRobot cannot be moved.
  std::vector<std::unique_ptr<GatewayRobot>> robots_;
  std::vector<PlayerLabel> players_;
  /** Serialized, as it was sent last. */
  std::string last_list_;
};

}  // namespace nao::gateway
