#include "phone-gateway/server/core/attraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace nao::gateway {
namespace {

/** A ball that was not seen for longer, s, is not looked at. Chosen. */
constexpr double kMaxBallAge = 3;
/** Fraction of the joints' highest speed. Chosen: as the app's. */
constexpr double kLookSpeed = 0.3;

}  // namespace

void Attraction::step(bool may_begin, double volume, double now) {
  if (!may_begin) {
    if (is_active_) end(now);
    // The robot does nothing in the first period after a visitor.
    next_ = now + settings_.attract_period;
    return;
  }
  if (settings_.attract_period <= 0 || now < next_) return;
  next_ = now + settings_.attract_period;
  begin_next(volume, now);
}

void Attraction::begin_next(double volume, double now) {
  std::vector<std::string> actions = settings_.attract_actions;
  if (settings_.attracts_with_motions) {
    for (const std::string& name : robot_.motions().listed()) actions.push_back(name);
  }
  const size_t num_looks = settings_.looks_at_ball ? 1 : 0;
  const size_t num_all = actions.size() + settings_.greetings.size() + num_looks;
  if (num_all == 0) return;
  is_active_ = true;
  size_t item = num_begun_++ % num_all;
  if (item < actions.size()) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    robot_.driving().command_by_itself(ActionCommand{actions[item], nan, nan, nan}, now);
    return;
  }
  item -= actions.size();
  if (item < settings_.greetings.size()) {
    const auto& [language, text] = settings_.greetings[item];
    SpeechCommand speech;
    speech.text = text;
    speech.language = language;
    speech.volume = volume;
    robot_.services().send({}, speech, now);
    return;
  }
  look_at_ball(now);
}

void Attraction::look_at_ball(double now) {
  const naoremote::RobotDescription& description = robot_.description();
  const naoremote::Vision& vision = robot_.perception().vision();
  if (!vision.has_ball() || vision.ball().age() > kMaxBallAge) return;
  const RobotSnapshot& robot = robot_.streams().mirror().robot();
  const Eigen::Vector2d ball =
      robot.torso_on_ground().inverse() * Eigen::Vector2d(vision.ball().x(), vision.ball().y());
  JointChangeCommand look;
  look.speed = kLookSpeed;
  for (const naoremote::JointGroup& group : description.joint_groups()) {
    if (group.name() != description.camera_group()) continue;
    // Pitch: down to the ball from about the height of the torso, which is below the camera.
    look.joint_names = {group.yaw_joint(), group.pitch_joint()};
    look.joint_position = {std::atan2(ball.y(), ball.x()),
                           std::atan2(robot.torso_position[2], ball.norm())};
  }
  for (size_t i = 0; i < look.joint_names.size(); ++i) {
    for (const naoremote::Joint& joint : description.joints()) {
      if (joint.name() != look.joint_names[i]) continue;
      look.joint_position[i] = std::clamp(look.joint_position[i], joint.lower(), joint.upper());
    }
  }
  if (!look.joint_names.empty()) robot_.driving().command_by_itself(std::move(look), now);
}

void Attraction::end(double now) {
  is_active_ = false;
  robot_.driving().command_by_itself(StopCommand{}, now);
  SpeechCommand silence;
  silence.operation = SpeechCommand::Operation::kStop;
  robot_.services().send({}, silence, now);
}

}  // namespace nao::gateway
