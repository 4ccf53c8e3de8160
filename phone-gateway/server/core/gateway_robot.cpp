#include "phone-gateway/server/core/gateway_robot.h"

#include <utility>

namespace nao::gateway {
namespace {

/** Calls a receiver, if there is one. */
template <class Message>
std::function<void(const Message&)> or_drop(std::function<void(const Message&)> receiver) {
  return [receiver = std::move(receiver)](const Message& message) {
    if (receiver) receiver(message);
  };
}

naoremote::ServerMessage make_component_notice(const ComponentMonitor::Change& change) {
  naoremote::ServerMessage message;
  naoremote::Notice& notice = *message.mutable_notice();
  notice.set_kind(naoremote::Notice::COMPONENT_CHANGED);
  write_reason(availability_reason(change.component, change.is_available), notice);
  notice.set_component(static_cast<naoremote::Notice::Component>(change.component));
  notice.set_is_available(change.is_available);
  return message;
}

}  // namespace

GatewayRobot::GatewayRobot(const GatewayLimits& limits, RobotSessions sessions,
                           const GatewayIdentity& identity, RobotSetup setup)
    : description_(std::move(setup.description)),
      sessions_(std::move(sessions)),
      drag_(std::move(setup.outputs.drag)),
      components_(limits),
      streams_(limits, sessions_, components_),
      commands_(sessions_, identity.source, identity.first_command_id,
                or_drop(std::move(setup.outputs.send))),
      services_(sessions_, identity.source, identity.first_command_id,
                or_drop(std::move(setup.outputs.send_service))),
      play_(limits, sessions_, identity.source, identity.first_command_id,
            or_drop(std::move(setup.outputs.send_play))),
      perception_(sessions_),
      driving_(limits, sessions_, components_, commands_, play_),
      motions_(limits, sessions_, identity.source + ".motions", identity.first_command_id,
               or_drop(std::move(setup.outputs.send_motion_file))) {}

naoremote::RobotDescription GatewayRobot::describe(double now) const {
  naoremote::RobotDescription description = description_;
  description.set_is_simulated(components_.is_simulated(now));
  for (const std::string& name : motions_.listed()) description.add_saved_motions(name);
  return description;
}

bool GatewayRobot::is_free() const {
  return components_.is_available(Component::kRobot) && driving_.driver() == 0;
}

void GatewayRobot::set_state(const RobotSnapshot& robot, double now) {
  components_.handle_robot_state(now);
  streams_.set_robot(robot, now);
}

void GatewayRobot::set_motion(const MotionSnapshot& motion, double now) {
  components_.handle_motion_state(motion.mode != Mode::kNoRobot, now);
  streams_.set_motion(motion);
}

void GatewayRobot::add_image(CachedImage image, double now) {
  components_.handle_image(now);
  streams_.add_image(std::move(image), now);
}

void GatewayRobot::set_play_state(naoremote::PlayState state) {
  play_.set_waits_for_release(state.reason_code() == kWaitsForRelease);
  perception_.set(std::move(state));
}

void GatewayRobot::handle_result(const CommandResult& result, double now) {
  if (result.kind == CommandKind::kSpeech || result.kind == CommandKind::kLight) {
    services_.handle_result(result, now);
    return;
  }
  if (result.kind == CommandKind::kPlay) {
    play_.handle_result(result, now);
    return;
  }
  commands_.handle_result(result, now);
  driving_.handle_result(result);
}

void GatewayRobot::report_missing_components(ClientSession& session) const {
  for (const Component component : kComponents) {
    if (!components_.is_available(component)) {
      session.send(make_component_notice({component, false}));
    }
  }
}

// Order: commands first, so that a walk that ends is sent before the notices to clients.
void GatewayRobot::step(double now) {
  driving_.step(now);
  play_.step(now);
  commands_.step(now);
  services_.step(now);
  motions_.step(now);
  step_components(now);
  streams_.step(now);
}

void GatewayRobot::step_components(double now) {
  components_.set_images_requested(streams_.has_image_client(now), now);
  for (const ComponentMonitor::Change& change : components_.step(now)) {
    sessions_.broadcast(make_component_notice(change));
    streams_.handle_component_change();
    if (change.component != Component::kMotion || change.is_available) continue;
    // The motion that it executed has ended, and is not continued when it is available again.
    driving_.abandon_motion();
    commands_.fail_all(availability_reason(Component::kMotion, false), now);
  }
}

}  // namespace nao::gateway
