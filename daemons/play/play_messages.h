#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <naolcm/play_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "daemons/play/play_core.h"
#include "robot_model/robot_model.h"

namespace nao::play {

/** A robot_state_t, as far as behaviors need it. */
struct RobotPose {
  Eigen::Isometry3d torso_in_odometry = Eigen::Isometry3d::Identity();
  /** rad, motor order. */
  std::vector<double> position;
};

/** @throws MessageError  for an unknown or missing joint, or a number that is not finite. */
RobotPose decode_pose(const RobotModel& model, const naolcm::robot_state_t& state);

/** The torso's ground poses in the last second, to relate what was seen to the pose at that time.
 */
class TorsoHistory {
 public:
  void add(int64_t utime, const Pose2& torso_in_odometry);
  /** The pose at the nearest time. @return Nothing if there is none within 0.1 s. */
  std::optional<Pose2> find(int64_t utime) const;

 private:
  std::deque<std::pair<int64_t, Pose2>> poses_;
};

/** @throws MessageError  for a number that is not finite. */
Vision decode_vision(const naolcm::vision_state_t& message, const TorsoHistory& torso);

/** Converts what a teammate's vision reports about itself and the ball.
 * @throws MessageError  for a number that is not finite. */
TeamObservation decode_observation(const naolcm::vision_state_t& message);

/** @param utime  Robot time, microseconds. */
naolcm::play_state_t encode_state(const PlayState& state, int64_t utime);

}  // namespace nao::play
