#pragma once

#include <functional>
#include <string>

#include "messages/command.h"
#include "phone-gateway/server/core/client_commands.h"
#include "phone-gateway/server/core/component_monitor.h"
#include "phone-gateway/server/core/driving.h"
#include "phone-gateway/server/core/gateway_identity.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/motion_library.h"
#include "phone-gateway/server/core/motion_messages.h"
#include "phone-gateway/server/core/perception_stream.h"
#include "phone-gateway/server/core/play_stream.h"
#include "phone-gateway/server/core/robot_sessions.h"
#include "phone-gateway/server/core/service_commands.h"
#include "phone-gateway/server/core/streams.h"

namespace nao::gateway {

/** Receivers of the commands for one robot. Those for which nothing is set are dropped. */
struct RobotOutputs {
  std::function<void(const Command&)> send = {};
  std::function<void(const ServiceCommand&)> send_service = {};
  std::function<void(const MotionFileCommand&)> send_motion_file = {};
  std::function<void(const DragCommand&)> drag = {};
  std::function<void(const SentPlayCommand&)> send_play = {};
};

/** A robot of the gateway, as it is set up. */
struct RobotSetup {
  naoremote::RobotDescription description;
  RobotOutputs outputs;
};

/** One robot: who drives it, what its clients are sent, and the commands that go to it. */
class GatewayRobot {
 public:
  /** @param sessions  Those that watch this robot.
   * @param identity  Of the gateway. */
  GatewayRobot(const GatewayLimits& limits, RobotSessions sessions, const GatewayIdentity& identity,
               RobotSetup setup);
  // The members refer to one another.
  GatewayRobot(const GatewayRobot&) = delete;
  GatewayRobot& operator=(const GatewayRobot&) = delete;

  /** As it was set up: without what changes. */
  const naoremote::RobotDescription& description() const { return description_; }
  const std::string& name() const { return description_.name(); }
  /** With what changes: the taught motions, whether it is simulated. */
  naoremote::RobotDescription describe(double now) const;

  /** Whether the robot answers and no client drives it. */
  bool is_free() const;

  // ---- Messages of the robot ----

  void set_state(const RobotSnapshot& robot, double now);
  void set_motion(const MotionSnapshot& motion, double now);
  /** An image of a camera of its own. */
  void add_image(CachedImage image, double now);
  void handle_result(const CommandResult& result, double now);

  /** Pulls a link of the simulated robot. */
  void drag(const DragCommand& command) const {
    if (drag_) drag_(command);
  }

  /** Tells a client which components are unavailable. */
  void report_missing_components(ClientSession& session) const;

  /** Repetitions, timeouts and availability. */
  void step(double now);

  // ---- Parts ----

  const ComponentMonitor& components() const { return components_; }
  ComponentMonitor& components() { return components_; }
  const Streams& streams() const { return streams_; }
  Streams& streams() { return streams_; }
  const Driving& driving() const { return driving_; }
  Driving& driving() { return driving_; }
  ServiceCommands& services() { return services_; }
  PerceptionStream& perception() { return perception_; }
  const PerceptionStream& perception() const { return perception_; }
  void set_play_state(naoremote::PlayState state);
  MotionLibrary& motions() { return motions_; }

 private:
  void step_components(double now);

  naoremote::RobotDescription description_;
  RobotSessions sessions_;
  std::function<void(const DragCommand&)> drag_;
  ComponentMonitor components_;
  Streams streams_;
  ClientCommands commands_;
  ServiceCommands services_;
  PlayStream play_;
  PerceptionStream perception_;
  Driving driving_;
  MotionLibrary motions_;
};

}  // namespace nao::gateway
