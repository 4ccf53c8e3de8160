#pragma once

#include <limits>

#include "common/constants.h"
#include "daemons/motion/joint_targets.h"
#include "daemons/motion/robot_state.h"
#include "kinematics/kinematics.h"
#include "kinematics/pose2.h"
#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {

/** A gait without the corrections for a real robot's servos: with it, joint targets are joint
 * angles. */
inline Gait ideal_gait() {
  Gait gait = nao_gait();
  gait.servo = {};
  gait.orientation = {};
  return gait;
}

/** A robot whose joints are where the last targets put them, and whose lower foot neither slips nor
 * tips: kinematics in place of physics. For walks with ideal_gait(). */
class IdealWalker {
 public:
  IdealWalker() {
    targets_.position = nao_model().find_posture("StandInit")->position;
    targets_.velocity.assign(targets_.position.size(), 0.0);
    targets_.stiffness.assign(targets_.position.size(), 1.0);
    state_.center_of_pressure_in_odometry.setConstant(std::numeric_limits<double>::quiet_NaN());
    measure();
  }

  JointTargets& targets() { return targets_; }
  const RobotState& state() const { return state_; }
  const Kinematics& kinematics() const { return kinematics_; }
  Pose2 torso() const { return Pose2::from(state_.torso_in_odometry); }

  /** Moves the joints to the targets. */
  void measure() {
    kinematics_.update(targets_.position);
    state_.joint_position = targets_.position;
    place();
    if (other_sole().translation().z() < -1e-9) {
      // The other foot has gone below the ground: it carries the robot from now on.
      support_ = Pose2::from(other_sole());
      stands_on_left_ = !stands_on_left_;
      place();
    }
    const double weight = nao_model().total_mass() * kGravity;
    const bool is_double_support = other_sole().translation().z() < kContactHeight;
    const double support_force = is_double_support ? weight / 2 : weight;
    const double other_force = is_double_support ? weight / 2 : 0;
    state_.left_foot_force = stands_on_left_ ? support_force : other_force;
    state_.right_foot_force = stands_on_left_ ? other_force : support_force;
    state_.left_foot_carries = state_.left_foot_force > 0;
    state_.right_foot_carries = state_.right_foot_force > 0;
  }

 private:
  static constexpr double kContactHeight = 2e-4;  // m

  const Eigen::Isometry3d& other_sole() const {
    return stands_on_left_ ? state_.right_sole_in_odometry : state_.left_sole_in_odometry;
  }

  void place() {
    Eigen::Isometry3d support = Eigen::Isometry3d::Identity();
    support.translation().head<2>() = support_.position;
    support.linear() =
        Eigen::AngleAxisd(support_.heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Isometry3d& sole =
        stands_on_left_ ? kinematics_.left_sole() : kinematics_.right_sole();
    state_.torso_in_odometry = support * sole.inverse();
    state_.left_sole_in_odometry = state_.torso_in_odometry * kinematics_.left_sole();
    state_.right_sole_in_odometry = state_.torso_in_odometry * kinematics_.right_sole();
    state_.center_of_mass_in_odometry = state_.torso_in_odometry * kinematics_.center_of_mass();
  }

  JointTargets targets_;
  RobotState state_;
  Kinematics kinematics_{nao_model()};
  bool stands_on_left_ = true;
  Pose2 support_;
};

}  // namespace nao::motion
