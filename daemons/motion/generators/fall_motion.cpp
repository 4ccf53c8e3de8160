#include "daemons/motion/generators/fall_motion.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

// Fraction of the peak torque during a fall. Chosen: the gears of stiff joints take the whole
// impact, limp arms do not stay between body and ground.
constexpr double kStiffness = 0.3;
// Least and greatest duration of a fall, s: a fall from standing takes about the least one.
constexpr double kMinDuration = 0.6;
constexpr double kMaxDuration = 3.0;
// Angular velocity of the torso below which it lies still, rad/s, and the time for which it must
// be, s.
constexpr double kLandedVelocity = 0.3;
constexpr double kLandedTime = 0.1;
// Time over which the direction of up is extrapolated to find the direction of the fall, s. Chosen:
// about the time from the prediction of a fall to the impact.
constexpr double kPredictionTime = 0.3;

/** Writes the angles of the joints that a pose names. */
void write_pose(const std::vector<double>& pose, std::vector<double>& position) {
  for (size_t i = 0; i < pose.size(); ++i) {
    if (!std::isnan(pose[i])) position[i] = pose[i];
  }
}

}  // namespace

void FallMotion::start(const MotionContext& context, const JointTargets& targets) {
  pose_ = targets.position;
  time_ = 0;
  time_still_ = 0;
  // Up in the torso frame changes by -w x up: a fall to the front makes its x component negative.
  // Third row of R_OT: the vertical of odometry in the torso frame.
  const Eigen::Vector3d up = context.state.torso_in_odometry.linear().row(2);
  const Eigen::Vector3d later =
      up - kPredictionTime * context.state.angular_velocity_torso.cross(up);
  const FallPoses& poses = context.model.references().fall;
  // The largest horizontal component names the side on which the robot will land.
  if (std::abs(later.y()) > std::abs(later.x())) {
    write_pose(poses.sideways, pose_);
  } else if (later.x() < 0) {
    write_pose(poses.forward, pose_);
  } else {
    write_pose(poses.backward, pose_);
  }
}

MotionGenerator::Phase FallMotion::step(const MotionContext& context, JointTargets& targets) {
  time_ += context.dt;
  // The joints move at the motors' greatest speed, since the core limits the targets.
  targets.position = pose_;
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), kStiffness);
  const bool is_still = context.state.angular_velocity_torso.norm() < kLandedVelocity;
  time_still_ = is_still ? time_still_ + context.dt : 0;
  const bool lies_still = time_ >= kMinDuration && time_still_ >= kLandedTime;
  if (!lies_still && time_ < kMaxDuration) return Phase::kRunning;
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), 1.0);
  return Phase::kDone;
}

}  // namespace nao::motion
