#include "phone-gateway/server/core/robots.h"

#include <algorithm>
#include <utility>

#include "common/joined.h"
#include "messages/command.h"

namespace nao::gateway {

Robots::Robots(const GatewayLimits& limits, Sessions& sessions, const GatewayIdentity& identity,
               std::vector<RobotSetup> setups)
    : sessions_(sessions) {
  const bool has_several = setups.size() > 1;
  for (RobotSetup& setup : setups) {
    const std::string label = has_several ? setup.description.name() : "";
    robots_.push_back(std::make_unique<GatewayRobot>(
        limits, RobotSessions(sessions, robots_.size(), label), identity, std::move(setup)));
  }
  last_list_ = list().SerializeAsString();
}

std::optional<size_t> Robots::find(const std::string& name) const {
  for (size_t i = 0; i < size(); ++i) {
    if (at(i).name() == name) return i;
  }
  return std::nullopt;
}

size_t Robots::choose() const {
  for (size_t i = 0; i < size(); ++i) {
    if (at(i).is_free()) return i;
  }
  return 0;
}

Refusal Robots::refuse_unknown(const std::string& name) const {
  return {naoremote::INVALID_ARGUMENT,
          gateway_reason("robot-unknown", {quoted(name), joined(robots_, &GatewayRobot::name)})};
}

void Robots::change(ClientSession& session, size_t robot, double now) {
  if (session.robot == robot) return;
  GatewayRobot& next = at(robot);
  GatewayRobot& previous = of(session);
  // First, so that it gets no notice of the robot that it leaves.
  session.robot = robot;
  previous.driving().handle_departure(session, next.name(), now);
  next.streams().adopt(session, next.description());
  naoremote::ServerMessage message;
  naoremote::Notice& notice = *message.mutable_notice();
  notice.set_kind(naoremote::Notice::ROBOT_CHANGED);
  write_reason(gateway_reason("robot-changed", {next.name()}), notice);
  *notice.mutable_robot() = next.describe(now);
  *notice.mutable_control() = next.driving().control().describe(session);
  session.send(message);
  next.report_missing_components(session);
}

naoremote::RobotList Robots::list() const {
  naoremote::RobotList list;
  if (size() < 2) return list;
  for (const auto& robot : robots_) {
    naoremote::RobotList::Robot& listed = *list.add_robots();
    listed.set_name(robot->name());
    listed.set_model(robot->description().model());
    listed.set_driver_id(robot->driving().driver());
    listed.set_driver_name(robot->driving().control().driver_name());
    listed.set_is_available(robot->components().is_available(Component::kRobot));
    const auto player = std::find_if(players_.begin(), players_.end(), [&](const auto& label) {
      return label.robot == robot->name();
    });
    if (player == players_.end()) continue;
    listed.set_team(player->team);
    listed.set_number(player->number);
  }
  return list;
}

std::vector<CameraRequest> Robots::camera_requests(size_t robot, double now) const {
  const auto is_overview = [](const CameraRequest& request) {
    return request.image.camera == kOverviewCamera;
  };
  std::vector<CameraRequest> requests = at(robot).streams().camera_requests(now);
  if (robot != 0) std::erase_if(requests, is_overview);
  for (size_t other = 1; robot == 0 && other < size(); ++other) {
    for (const CameraRequest& request : at(other).streams().camera_requests(now)) {
      if (is_overview(request)) merge(request, requests);
    }
  }
  return requests;
}

void Robots::add_image(size_t robot, CachedImage image, double now) {
  if (image.camera != kOverviewCamera) return at(robot).add_image(std::move(image), now);
  for (const auto& other : robots_) other->streams().add_image(image, now);
}

void Robots::step(double now) {
  for (const auto& robot : robots_) robot->step(now);
  if (size() < 2) return;
  naoremote::RobotList now_listed = list();
  std::string bytes = now_listed.SerializeAsString();
  if (bytes == last_list_) return;
  last_list_ = std::move(bytes);
  naoremote::ServerMessage message;
  message.mutable_notice()->set_kind(naoremote::Notice::ROBOTS_CHANGED);
  *message.mutable_notice()->mutable_robots() = std::move(now_listed);
  sessions_.broadcast(message);
}

}  // namespace nao::gateway
