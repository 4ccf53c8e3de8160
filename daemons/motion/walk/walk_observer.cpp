#include "daemons/motion/walk/walk_observer.h"

#include <algorithm>
#include <cmath>

#include "kinematics/pose2.h"

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Bound of the tilt that is fed back, rad. Chosen: up to it small-angle approximations are within
// 2 %; the walk ends at 0.6 rad.
constexpr double kMaxTilt = 0.35;

}  // namespace

void WalkObserver::start(bool is_pushed) {
  gyroscope_.reset();
  starts_pushed_ = is_pushed;
  has_estimate_ = false;
}

void WalkObserver::update(const RobotState& state, const Vector3d& com_in_torso,
                          bool support_is_left, const ComReference& reference, double torso_pitch,
                          double dt) {
  soles_in_odometry_ = {Pose2::from(state.left_sole_in_odometry),
                        Pose2::from(state.right_sole_in_odometry)};
  estimate_com(state, com_in_torso, support_is_left, reference, dt);

  // Roll and pitch of the torso in its heading frame H.
  const Matrix3d& R_OT = state.torso_in_odometry.linear();
  torso_heading_ = heading_of(R_OT);
  const Matrix3d R_HT = AngleAxisd(-torso_heading_, Vector3d::UnitZ()).toRotationMatrix() * R_OT;
  // R_HT = Ry(pitch) Rx(roll): the heading has been taken out. Subtracting the commanded pitch
  // leaves the tilt that was not commanded.
  tilt_ << std::atan2(R_HT(2, 1), R_HT(2, 2)), std::asin(std::clamp(-R_HT(2, 0), -1.0, 1.0)), 0;
  tilt_.y() -= torso_pitch;
  tilt_ = tilt_.cwiseMax(-kMaxTilt).cwiseMin(kMaxTilt);
  gyroscope_.update(state.angular_velocity_torso, dt);
  swing_force_ = support_is_left ? state.right_foot_force : state.left_foot_force;
}

void WalkObserver::estimate_com(const RobotState& state, const Vector3d& com_in_torso,
                                bool support_is_left, const ComReference& reference, double dt) {
  const Pose2& support = sole_in_odometry(support_is_left);
  // Measured center of mass in odometry, and in S by the sole's pose in odometry.
  const Vector3d com = state.torso_in_odometry * com_in_torso;
  const Pose2 to_support = support.inverse();
  const Vector2d position = to_support * Vector2d(com.head<2>());
  // Without weight on the feet the commanded ZMP stands in for the center of pressure.
  Vector2d zmp = to_support * state.center_of_pressure_in_odometry;
  if (!zmp.allFinite()) zmp = reference.zmp();
  // There are three cases: the first tick; a changed support foot, for which position and velocity
  // are re-expressed in the new S; and the usual update of the filter.
  if (!has_estimate_ && starts_pushed_) {
    estimator_.reset(
        {position, to_support.rotate(state.center_of_mass_velocity_in_odometry.head<2>())});
    has_estimate_ = true;
  } else if (!has_estimate_) {
    estimator_.reset(position, zmp);
    has_estimate_ = true;
  } else if (support_is_left != support_was_left_) {
    estimator_.change_frame(position, support.heading - support_heading_);
  } else {
    estimator_.update(position, zmp, reference.omega(), dt);
  }
  support_was_left_ = support_is_left;
  support_heading_ = support.heading;
  com_ = {estimator_.state().position - estimator_.offset(), estimator_.state().velocity};
}

Pose2 WalkObserver::midpoint_in_odometry() const {
  return {0.5 * (soles_in_odometry_[0].position + soles_in_odometry_[1].position), torso_heading_};
}

}  // namespace nao::motion
