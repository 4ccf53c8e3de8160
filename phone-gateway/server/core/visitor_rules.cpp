#include "phone-gateway/server/core/visitor_rules.h"

#include <algorithm>

#include "messages/command.h"

namespace nao::gateway {
namespace {

using naoremote::Request;

/** A ball that was not seen for longer, s, may be anywhere. Chosen: some images in which the
 * robot's own foot hides it. */
constexpr double kMaxBallUnseen = 0.5;

Refusal forbid(const std::string& what) {
  return {naoremote::NOT_ALLOWED, gateway_reason("exhibition-forbidden", {what})};
}

}  // namespace

bool VisitorRules::is_forbidden(const std::string& action) const {
  std::string kind;
  for (const naoremote::ActionRole& role : robot_.description().action_roles()) {
    if (role.name() == action) kind = role.kind();
  }
  if (choices_.forbids_kicks && kind == "kick") return true;
  if (choices_.forbids_falls && (kind == "dive" || kind == "block")) return true;
  return std::any_of(settings_.forbidden.begin(), settings_.forbidden.end(),
                     [&](const auto& name) { return name == action || name == kind; });
}

bool VisitorRules::is_inside(const naoremote::MoveTo& move) const {
  const Pose2 robot = place_.pose();
  return is_place_known() &&
         fence_.allows_way(robot.position, robot * Eigen::Vector2d(move.x(), move.y()));
}

std::optional<Refusal> VisitorRules::check(const Request& request) const {
  switch (request.use_case_case()) {
    case Request::kTakeControl:
    case Request::kWatchRobot:
      return Refusal{naoremote::NOT_ALLOWED, gateway_reason("exhibition-queue")};
    case Request::kDoAction:
      if (is_forbidden(request.do_action().action())) {
        return forbid(quoted(request.do_action().action()));
      }
      return std::nullopt;
    case Request::kMoveTo:
      if (fence_.is_set() && !is_inside(request.move_to())) {
        return Refusal{naoremote::NOT_ALLOWED, gateway_reason("exhibition-fence")};
      }
      return std::nullopt;
    case Request::kSay:
      if (!settings_.may_speak) return forbid("Say");
      return std::nullopt;
    case Request::kPlay:
      if (!settings_.may_play) return forbid("Play");
      return std::nullopt;
    case Request::kChangeJoints:
      if (request.change_joints().has_stiffness() || request.change_joints().allow_tipping()) {
        return forbid("stiffness, allow_tipping");
      }
      return std::nullopt;
    case Request::kDrag:
      return forbid("Drag");
    case Request::kCheckMotion:
    case Request::kSaveMotion:
    case Request::kDeleteMotion:
      return forbid("CheckMotion, SaveMotion, DeleteMotion");
    default:
      return std::nullopt;
  }
}

WalkCommand VisitorRules::limit(const WalkCommand& velocity) const {
  const double factor = settings_.speed * choices_.speed;
  const WalkCommand slower{factor * velocity.vx, factor * velocity.vy, factor * velocity.wz};
  if (!fence_.is_set()) return slower;
  // Without a place nobody knows where the border is.
  return is_place_known() ? fence_.limit(slower, place_.pose()) : WalkCommand{};
}

// On the field nobody knows where odometry began, until the robot has seen where it is.
bool VisitorRules::is_place_known() const {
  return place_.is_known() && (!settings_.is_fence_on_field || vision_utime_ != 0);
}

std::optional<Eigen::Vector2d> VisitorRules::robot() const {
  if (!is_place_known()) return std::nullopt;
  return place_.pose().position;
}

std::optional<Eigen::Vector2d> VisitorRules::ball() const {
  const naoremote::Vision& vision = robot_.perception().vision();
  if (!is_place_known() || !vision.has_ball() || vision.ball().age() > kMaxBallUnseen) {
    return std::nullopt;
  }
  const Pose2 odometry = robot_.streams().mirror().robot().torso_on_ground();
  return place_.pose() *
         (odometry.inverse() * Eigen::Vector2d(vision.ball().x(), vision.ball().y()));
}

void VisitorRules::step() {
  const RobotMirror& mirror = robot_.streams().mirror();
  if (!mirror.has_state()) return;
  place_.update(mirror.robot().utime, mirror.robot().torso_on_ground());
  if (!settings_.is_fence_on_field) return;
  const naoremote::Vision& vision = robot_.perception().vision();
  if (!vision.has_field_pose() || vision.utime() == vision_utime_) return;
  vision_utime_ = vision.utime();
  const naoremote::Vision::FieldPose& pose = vision.field_pose();
  place_.correct({{pose.x(), pose.y()}, pose.theta()});
}

}  // namespace nao::gateway
