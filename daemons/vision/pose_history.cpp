#include "daemons/vision/pose_history.h"

#include <algorithm>

namespace nao::vision {
namespace {

/** Microseconds. */
constexpr int64_t kLength = 1000000;
constexpr int64_t kMostGap = 100000;
constexpr int64_t kMostLead = 30000;
/** Cosine of the torso's tilt beyond which the robot falls or lies; 35 degrees. */
constexpr double kUprightCosine = 0.82;

// Position linearly, orientation by spherical linear interpolation, joints linearly.
RobotPosture interpolated(const RobotPosture& from, const RobotPosture& to, double fraction) {
  RobotPosture result = to;
  const Eigen::Quaterniond a(from.pose_torso_in_odometry.linear());
  const Eigen::Quaterniond b(to.pose_torso_in_odometry.linear());
  result.pose_torso_in_odometry.linear() = a.slerp(fraction, b).toRotationMatrix();
  result.pose_torso_in_odometry.translation() =
      (1 - fraction) * from.pose_torso_in_odometry.translation() +
      fraction * to.pose_torso_in_odometry.translation();
  for (size_t i = 0; i < result.position.size(); ++i) {
    result.position[i] = (1 - fraction) * from.position[i] + fraction * to.position[i];
  }
  return result;
}

}  // namespace

// Messages out of order are dropped; a large step backwards in time is a restart.
void PoseHistory::add(const RobotPosture& posture) {
  if (!history_.empty() && posture.utime <= history_.back().utime) {
    if (history_.back().utime - posture.utime < kLength) return;
    history_.clear();
  }
  history_.push_back(posture);
  while (history_.back().utime - history_.front().utime > kLength) history_.pop_front();
}

Eigen::Isometry3d PoseHistory::camera_in_odometry(const RobotPosture& posture, int link) {
  kinematics_.update(posture.position);
  return posture.pose_torso_in_odometry * kinematics_.link_pose(link);
}

std::optional<CameraPose> PoseHistory::find(const std::string& camera, int64_t utime) {
  const auto model = std::find_if(model_.cameras().begin(), model_.cameras().end(),
                                  [&](const CameraModel& c) { return c.name == camera; });
  if (model == model_.cameras().end() || history_.empty()) return std::nullopt;
  const auto next = std::lower_bound(
      history_.begin(), history_.end(), utime,
      [](const RobotPosture& posture, int64_t time) { return posture.utime < time; });
  RobotPosture posture;
  if (next == history_.end()) {
    posture = history_.back();
    // An image may be a little newer than the last state; that state is used then.
    if (utime - posture.utime > kMostLead) return std::nullopt;
  } else if (next->utime == utime) {
    posture = *next;
  } else {
    if (next == history_.begin()) return std::nullopt;
    const RobotPosture& from = *std::prev(next);
    // A gap: the robot may have moved in between in ways that are not known.
    if (next->utime - from.utime > kMostGap) return std::nullopt;
    posture = interpolated(
        from, *next,
        static_cast<double>(utime - from.utime) / static_cast<double>(next->utime - from.utime));
  }
  CameraPose result;
  const Eigen::Isometry3d pose = camera_in_odometry(posture, model->link);
  result.heading_in_odometry = Pose2::from(posture.pose_torso_in_odometry);
  result.is_upright = posture.pose_torso_in_odometry.linear()(2, 2) > kUprightCosine;
  // Heading frame H: on the ground below the torso, with its heading.
  Eigen::Isometry3d heading = Eigen::Isometry3d::Identity();
  heading.translation().head<2>() = result.heading_in_odometry.position;
  heading.linear() =
      Eigen::AngleAxisd(result.heading_in_odometry.heading, Eigen::Vector3d::UnitZ()).matrix();
  result.pose_camera_in_heading = heading.inverse() * pose;
  return result;
}

}  // namespace nao::vision
