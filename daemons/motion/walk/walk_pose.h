#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "daemons/motion/walk/com_reference.h"
#include "daemons/motion/walk/feet.h"
#include "daemons/motion/walk/gait.h"
#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Joint angles that put center of mass, torso and feet where the walk commands them.
 *
 * The torso has a constant pitch and height over the support foot, and half the heading of the
 * other foot. Its horizontal position follows from the reference of the center of mass and from
 * where the center of mass is in the torso. That point moves with the legs and is low-pass
 * filtered. The legs follow by inverse kinematics, the arms swing against the stride. */
class WalkPose {
 public:
  WalkPose(const RobotModel& model, const Gait& gait);

  const LegKinematics& legs() const { return legs_; }
  /** Motors that the walk moves: legs and arms. */
  const std::vector<int>& motors() const { return motors_; }

  /** Begins in a pose with both feet on the ground. @param position  rad, (num_motors). */
  void start(const std::vector<double>& position);
  /** In the pose of start(): right sole seen from the left one; height of the center of mass over
   * the left sole, m; time that lowering the torso and moving the arms should take, s. */
  Pose2 start_right_sole() const { return Pose2::from(start_right_sole_); }
  double start_com_height() const { return (start_torso_ * com_in_torso_).z(); }
  double lowering_duration() const;

  /** Torso in the support frame S.
   * @param lowered  Fraction of the transition from the pose of start() to the walk's, 0..1. */
  Eigen::Isometry3d torso_in_support(const ComReference& reference, const Feet& feet,
                                     double lowered) const;

  /** Moves legs and arms to the pose for reference and feet.
   * @param swing_sole  In S. @param position  In and out: rad, (num_motors). */
  void solve(const ComReference& reference, const Feet& feet, const Eigen::Isometry3d& swing_sole,
             double lowered, std::vector<double>& position);

  /** Follows the center of mass of a pose of the joints. */
  void update_com(const std::vector<double>& position, double dt);

  /** Kinematics in the pose of the last update_com(). */
  const Kinematics& kinematics() const { return kinematics_; }
  /** Pitch of the torso in the last solve(), rad. */
  double torso_pitch() const { return torso_pitch_; }

 private:
  /** An arm joint: angle, rad, and change with the stride, rad/m. */
  struct ArmJoint {
    int motor;
    double angle;
    double swing_gain;
  };

  const Gait* gait_;
  LegKinematics legs_;
  Kinematics kinematics_;
  std::vector<ArmJoint> arms_;
  std::vector<int> motors_;

  std::vector<double> start_position_;
  /** In S at the start. */
  Eigen::Isometry3d start_torso_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d start_right_sole_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d com_in_torso_ = Eigen::Vector3d::Zero();
  double torso_pitch_ = 0;
};

}  // namespace nao::motion
