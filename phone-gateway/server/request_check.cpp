#include "phone-gateway/server/request_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace nao {
namespace {

constexpr double kDefaultPostureSpeed = 0.5;
constexpr double kDefaultJointSpeed = 0.3;
// A joint's whole range is below 2 pi; more is a client's mistake, not a wish.
constexpr double kMaxJointChange = 6.3;
constexpr double kMaxDistance = 10;
// A little over pi, so that a rounded half turn passes.
constexpr double kMaxHeading = 3.15;
constexpr double kMaxBallDistance = 10;

/** False for what is not finite, too. */
bool is_within(double value, double low, double high) {
  return value >= low && value <= high;
}

bool is_within(double value, double limit) {
  return is_within(value, -limit, limit);
}

template <class Names>
bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** A name that came from outside, made fit for a sentence. */
std::string quoted(const std::string& name) {
  constexpr size_t kMaxShown = 40;
  std::string shown;
  for (const char c : name.substr(0, kMaxShown)) {
    shown.push_back(c >= ' ' && c < '\x7f' ? c : '?');
  }
  return "'" + shown + (name.size() > kMaxShown ? "...'" : "'");
}

/** Speed fraction, with 0 replaced by the default; NaN if it is out of range. */
double speed_or_default(double speed, double default_speed) {
  if (speed == 0) return default_speed;
  return speed > 0 && speed <= 1 ? speed : std::numeric_limits<double>::quiet_NaN();
}

const Refusal kBadSpeed{"The speed must be above 0 and at most 1."};

/** nullptr if the robot has no such group. */
const naoremote::JointGroup* find_group(const PhoneRobot& robot, const std::string& name) {
  for (const naoremote::JointGroup& group : robot.description.joint_groups()) {
    if (group.name() == name) return &group;
  }
  return nullptr;
}

/** "right knee" for "left knee" and the other way round; the same name for what has no side. */
std::string other_side(const std::string& name) {
  const std::string left = "left ";
  const std::string right = "right ";
  if (name.rfind(left, 0) == 0) return right + name.substr(left.size());
  if (name.rfind(right, 0) == 0) return left + name.substr(right.size());
  return name;
}

/** Adds a group's joints to a change; a joint that is in it already stays as it is.
 * @param mirror  1, or -1 for the other side, where yaw and roll turn the other way. */
std::optional<Refusal> add_group(const naoremote::JointGroup& group,
                                 const naoremote::ChangeJoints& request, double mirror,
                                 JointChange& change) {
  struct Axis {
    const char* name;
    const std::string& joint;
    double change;
  };
  const std::array<Axis, 3> axes{{{"yaw", group.yaw_joint(), mirror * request.yaw()},
                                  {"pitch", group.pitch_joint(), request.pitch()},
                                  {"roll", group.roll_joint(), mirror * request.roll()}}};
  for (const Axis& axis : axes) {
    if (!is_within(axis.change, kMaxJointChange)) {
      return Refusal{std::string("The change of ") + axis.name + " is no angle within 6.3 rad."};
    }
    if (axis.change == 0) continue;
    if (axis.joint.empty()) {
      return Refusal{"The joint group " + group.name() + " has no " + axis.name + "."};
    }
    if (contains(change.joint_names, axis.joint)) continue;
    change.joint_names.push_back(axis.joint);
    change.change.push_back(axis.change);
  }
  return std::nullopt;
}

}  // namespace

std::variant<WalkVelocity, Refusal> check(const naoremote::WalkTurn& request,
                                          const PhoneRobot& robot) {
  if (!std::isfinite(request.vx()) || !std::isfinite(request.vy()) ||
      !std::isfinite(request.wz())) {
    return Refusal{"A walk velocity is not finite."};
  }
  const WalkLimits& limits = robot.walk_limits;
  return WalkVelocity{std::clamp(request.vx(), -limits.backward, limits.forward),
                      std::clamp(request.vy(), -limits.sideways, limits.sideways),
                      std::clamp(request.wz(), -limits.turning, limits.turning)};
}

std::variant<MotionCommand, Refusal> check(const naoremote::MoveTo& request) {
  if (!is_within(request.x(), kMaxDistance) || !is_within(request.y(), kMaxDistance) ||
      !is_within(request.theta(), kMaxHeading)) {
    return Refusal{"A place to walk to lies within 10 m ahead and aside, and half a turn."};
  }
  return RelativeGoal{request.x(), request.y(), request.theta()};
}

std::variant<MotionCommand, Refusal> check(const naoremote::GoToPosture& request,
                                           const PhoneRobot& robot) {
  if (!contains(robot.description.postures(), request.posture())) {
    return Refusal{"The robot knows no posture " + quoted(request.posture()) + "."};
  }
  const double speed = speed_or_default(request.speed(), kDefaultPostureSpeed);
  if (std::isnan(speed)) return kBadSpeed;
  return PostureGoal{request.posture(), speed};
}

std::variant<MotionCommand, Refusal> check(const naoremote::ChangeJoints& request,
                                           const PhoneRobot& robot) {
  const naoremote::JointGroup* group = find_group(robot, request.group());
  if (group == nullptr) {
    return Refusal{"The robot has no joint group " + quoted(request.group()) + "."};
  }
  JointChange change;
  change.speed = speed_or_default(request.speed(), kDefaultJointSpeed);
  if (std::isnan(change.speed)) return kBadSpeed;
  change.allow_tipping = request.allow_tipping();
  if (auto refusal = add_group(*group, request, 1, change)) return *refusal;
  if (request.both_sides()) {
    const naoremote::JointGroup* other = find_group(robot, other_side(group->name()));
    if (other != nullptr && other != group) {
      if (auto refusal = add_group(*other, request, -1, change)) return *refusal;
    }
  }
  if (change.joint_names.empty()) return Refusal{"No joint was to change."};
  return change;
}

std::variant<MotionCommand, Refusal> check(const naoremote::DoAction& request,
                                           const PhoneRobot& robot) {
  if (!contains(robot.description.actions(), request.action())) {
    return Refusal{"The robot knows no action " + quoted(request.action()) + "."};
  }
  const double unset = std::numeric_limits<double>::quiet_NaN();
  NamedAction action{request.action(), unset, unset, unset};
  if (request.has_ball_x() != request.has_ball_y()) {
    return Refusal{"A ball has two coordinates, x and y."};
  }
  if (request.has_ball_x()) {
    if (!is_within(request.ball_x(), kMaxBallDistance) ||
        !is_within(request.ball_y(), kMaxBallDistance)) {
      return Refusal{"The ball lies within 10 m."};
    }
    action.ball_x = request.ball_x();
    action.ball_y = request.ball_y();
  }
  if (request.has_strength()) {
    if (!(request.strength() > 0 && request.strength() <= 1)) {
      return Refusal{"The strength must be above 0 and at most 1."};
    }
    action.strength = request.strength();
  }
  return action;
}

std::variant<ImageSelection, Refusal> check(const naoremote::ImageRequest& request,
                                            const PhoneRobot& robot) {
  const auto& cameras = robot.description.cameras();
  ImageSelection selection;
  selection.camera = request.camera();
  if (selection.camera.empty() && !cameras.empty()) selection.camera = cameras[0];
  if (!contains(cameras, selection.camera)) {
    return Refusal{"The robot has no camera " + quoted(selection.camera) + "."};
  }
  if (request.width() != 0) selection.width = request.width();
  if (selection.width != 640 && selection.width != 320 && selection.width != 160) {
    return Refusal{"Images are 640, 320 or 160 pixels wide."};
  }
  selection.quality = request.quality();
  if (selection.quality > 95) return Refusal{"The quality of an image is 1 to 95."};
  return selection;
}

std::variant<Subscription, Refusal> check(const naoremote::Subscribe& request,
                                          const PhoneRobot& robot, const GatewayLimits& limits) {
  if (!is_within(request.state_rate(), 0, limits.max_state_rate) ||
      !is_within(request.image_rate(), 0, limits.max_image_rate)) {
    return Refusal{"At most 60 states and 30 images a second."};
  }
  Subscription subscription{request.state_rate(), request.image_rate(), {}};
  auto image = check(request.image(), robot);
  if (auto* refusal = std::get_if<Refusal>(&image)) return std::move(*refusal);
  subscription.image = std::get<ImageSelection>(image);
  return subscription;
}

}  // namespace nao
