#include "daemons/motion/walk/walk_pose.h"

#include <algorithm>
#include <cmath>

#include "common/smooth_step.h"

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

// Greatest velocity of the torso while it is lowered, m/s, and of the arm joints, rad/s, and least
// duration of the transition, s. Chosen: the reference of the center of mass rests during it, so
// the body must move slowly; the arms use about a quarter of their motors' greatest velocity.
constexpr double kLoweringSpeed = 0.08;
constexpr double kArmSpeed = 2.0;
constexpr double kMinLoweringDuration = 0.3;
// Greatest slope of smooth_step(), at s = 1/2.
constexpr double kMaxSlope = 1.875;

}  // namespace

WalkPose::WalkPose(const RobotModel& model, const Gait& gait)
    : gait_(&gait), legs_(model), kinematics_(model) {
  // Arm joints that swing with the stride, from robot.yaml.
  for (const WalkingArmJoint& joint : model.references().walking_arms) {
    arms_.push_back({joint.motor, joint.angle, joint.swing * gait.arms.swing_gain});
  }
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    for (const int motor : legs_.motors(leg)) {
      // HipYawPitch is one motor for both legs.
      if (std::find(motors_.begin(), motors_.end(), motor) == motors_.end()) {
        motors_.push_back(motor);
      }
    }
  }
  for (const ArmJoint& joint : arms_) motors_.push_back(joint.motor);
}

void WalkPose::start(const std::vector<double>& position) {
  start_position_ = position;
  kinematics_.update(position);
  // Torso and right sole in the frame of the left sole, which is S at the start.
  start_torso_ = kinematics_.left_sole().inverse();
  start_right_sole_ = start_torso_ * kinematics_.right_sole();
  com_in_torso_ = kinematics_.center_of_mass();
}

double WalkPose::lowering_duration() const {
  // Duration at constant velocity; smooth_step() is faster by kMaxSlope at its middle.
  const double height = gait_->stance.hip_height;
  double duration = std::abs(start_torso_.translation().z() - height + legs_.hip(Leg::kLeft).z()) /
                    kLoweringSpeed;
  for (const ArmJoint& joint : arms_) {
    duration = std::max(duration, std::abs(joint.angle - start_position_[joint.motor]) / kArmSpeed);
  }
  return std::max(kMinLoweringDuration, kMaxSlope * duration);
}

Isometry3d WalkPose::torso_in_support(const ComReference& reference, const Feet& feet,
                                      double lowered) const {
  // The torso's heading is the mean of both feet's; the support foot's is 0 in S.
  const double heading = wrapped(feet.swing().pose().heading) / 2;
  Isometry3d torso;
  torso.linear() = (AngleAxisd(heading, Vector3d::UnitZ()) *
                    AngleAxisd(gait_->stance.torso_pitch, Vector3d::UnitY()))
                       .toRotationMatrix();
  // Translation from com = torso * com_in_torso (x, y) and from the height of the hips (z).
  const Vector3d hips = 0.5 * (legs_.hip(Leg::kLeft) + legs_.hip(Leg::kRight));
  torso.translation() << reference.state().position - (torso.linear() * com_in_torso_).head<2>(),
      gait_->stance.hip_height - (torso.linear() * hips).z();
  // Interpolated from the pose of the start: position linearly, orientation on the great circle.
  if (lowered >= 1) return torso;
  Isometry3d between;
  between.translation() =
      (1 - lowered) * start_torso_.translation() + lowered * torso.translation();
  between.linear() = Eigen::Quaterniond(start_torso_.linear())
                         .slerp(lowered, Eigen::Quaterniond(torso.linear()))
                         .toRotationMatrix();
  return between;
}

void WalkPose::solve(const ComReference& reference, const Feet& feet, const Isometry3d& swing_sole,
                     double lowered, std::vector<double>& position) {
  const Isometry3d torso = torso_in_support(reference, feet, lowered);
  torso_pitch_ = std::asin(std::clamp(-torso.linear()(2, 0), -1.0, 1.0));
  const Isometry3d to_torso = torso.inverse();
  const Isometry3d support = to_torso * feet.support_sole();
  const Isometry3d swing = to_torso * swing_sole;
  const bool support_is_left = feet.support_is_left();
  const LegsSolution solution =
      legs_.solve_both(support_is_left ? support : swing, support_is_left ? swing : support);
  legs_.write(Leg::kLeft, solution.left, position);
  legs_.write(Leg::kRight, solution.right, position);
  // Lead of the right foot on the left one.
  // side() is +1 for a left support foot: the swing foot is then the right one.
  const double stride = feet.swing().pose().position.x() * feet.side();
  for (const ArmJoint& joint : arms_) {
    const double angle = joint.angle + joint.swing_gain * stride;
    const double start = start_position_[joint.motor];
    position[joint.motor] = lowered < 1 ? start + lowered * (angle - start) : angle;
  }
}

void WalkPose::update_com(const std::vector<double>& position, double dt) {
  kinematics_.update(position);
  // The center of mass moves in the torso with legs and arms. A low-pass filter breaks the loop
  // between the pose of the torso and the center of mass that it is computed from.
  const double time_constant = gait_->stance.com_time_constant;
  const double weight = time_constant > dt ? dt / time_constant : 1.0;
  com_in_torso_ += weight * (kinematics_.center_of_mass() - com_in_torso_);
}

}  // namespace nao::motion
