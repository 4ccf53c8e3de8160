#include "daemons/play/play_messages.h"

#include <cmath>
#include <cstdlib>
#include <limits>

#include "common/error.h"
#include "messages/named_joints.h"
#include "messages/pose_message.h"

namespace nao::play {
namespace {

/** Microseconds. */
constexpr int64_t kHistoryLength = 1000000;
constexpr int64_t kHistoryGap = 100000;

}  // namespace

RobotPose decode_pose(const RobotModel& model, const naolcm::robot_state_t& state) {
  RobotPose pose;
  pose.position.assign(static_cast<size_t>(model.num_motors()), 0.0);
  const auto fault = read_named_joints(model.motor_names(), state.joint_names,
                                       {{"position", state.joint_position, pose.position}});
  if (fault) throw MessageError(to_sentence(*fault));
  pose.torso_in_odometry =
      nao::decode_pose(state.position_torso_in_odometry, state.orientation_torso_in_odometry);
  return pose;
}

void TorsoHistory::add(int64_t utime, const Pose2& torso_in_odometry) {
  // Time goes back when another simulation starts.
  if (!poses_.empty() && utime < poses_.back().first) poses_.clear();
  poses_.emplace_back(utime, torso_in_odometry);
  while (utime - poses_.front().first > kHistoryLength) poses_.pop_front();
}

std::optional<Pose2> TorsoHistory::find(int64_t utime) const {
  std::optional<Pose2> best;
  int64_t least = kHistoryGap;
  for (const auto& [time, pose] : poses_) {
    const int64_t gap = std::abs(time - utime);
    if (gap > least) continue;
    least = gap;
    best = pose;
  }
  return best;
}

Vision decode_vision(const naolcm::vision_state_t& message, const TorsoHistory& torso) {
  Vision vision;
  vision.time = 1e-6 * static_cast<double>(message.utime);
  vision.image_status = static_cast<uint8_t>(message.image_status);
  if (message.has_ball != 0) {
    Ball ball;
    ball.position = Eigen::Vector2d(message.ball_position_in_odometry);
    ball.velocity = Eigen::Vector2d(message.ball_velocity_in_odometry);
    ball.seen_time = 1e-6 * static_cast<double>(message.ball_utime);
    ball.is_rolling = message.is_ball_rolling != 0;
    if (!ball.position.allFinite() || !ball.velocity.allFinite()) {
      throw MessageError("the ball's position or velocity is not finite");
    }
    vision.ball = ball;
  }
  // Without the state at that time, nothing can be related to the odometry.
  const auto then = torso.find(message.utime);
  for (const naolcm::detection_t& detection : message.detections) {
    const Eigen::Vector2d place(detection.position_in_heading);
    if (then && detection.kind == detection.KIND_ROBOT && place.allFinite()) {
      vision.robots.push_back(*then * place);
    }
  }
  if (message.has_field_pose == 0) return vision;
  const double(&pose)[3] = message.torso_in_field;
  if (!(std::isfinite(pose[0]) && std::isfinite(pose[1]) && std::isfinite(pose[2]))) {
    throw MessageError("the pose on the field is not finite");
  }
  if (then) {
    const Pose2 torso_in_field{{pose[0], pose[1]}, pose[2]};
    vision.field_in_odometry = *then * torso_in_field.inverse();
  }
  return vision;
}

TeamObservation decode_observation(const naolcm::vision_state_t& message) {
  TeamObservation seen;
  seen.time = 1e-6 * static_cast<double>(message.utime);
  if (message.has_field_pose == 0) return seen;
  const Pose2 torso{{message.torso_in_field[0], message.torso_in_field[1]},
                    message.torso_in_field[2]};
  if (!torso.position.allFinite() || !std::isfinite(torso.heading)) {
    throw MessageError("the pose on the field is not finite");
  }
  seen.position = torso.position;
  for (const naolcm::detection_t& detection : message.detections) {
    const Eigen::Vector2d place(detection.position_in_heading);
    if (detection.kind == detection.KIND_BALL && place.allFinite()) seen.ball = torso * place;
  }
  return seen;
}

naolcm::play_state_t encode_state(const PlayState& state, int64_t utime) {
  naolcm::play_state_t message{};
  message.utime = utime;
  message.behavior = static_cast<int8_t>(state.behavior);
  message.role = static_cast<int8_t>(state.role);
  message.phase = static_cast<int8_t>(state.phase);
  message.command_source = state.command_source;
  message.command_id = state.command_id;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  message.target_in_field[0] = state.target_in_field ? state.target_in_field->x() : nan;
  message.target_in_field[1] = state.target_in_field ? state.target_in_field->y() : nan;
  message.reason_code = state.reason.code;
  message.reason = to_sentence(state.reason);
  return message;
}

}  // namespace nao::play
