#include "daemons/motion/estimator/state_estimator.h"

#include <algorithm>
#include <cmath>

#include "kinematics/support_polygon.h"

namespace nao::motion {
namespace {

// A foot that has come off must press a bit harder to count again, so that it does not flicker.
constexpr double kContactHysteresis = 1.5;
// The other foot takes over as the one that stands still when it carries this much more, N.
constexpr double kSwitchForce = 5.0;
// At rest nothing turns faster than this, rad/s: above the gyroscope's noise and bias, and well
// below any motion.
constexpr double kRestAngularVelocity = 0.06;
constexpr double kRestJointVelocity = 0.15;
constexpr double kSettlingTime = 0.3;  // s of rest before the gyroscope's bias is learnt
// Time constant of the velocities, s: three ticks, since differences of 0.1 degree encoder steps
// over 10 ms are noisy.
constexpr double kVelocityTimeConstant = 0.03;

}  // namespace

StateEstimator::StateEstimator(const RobotModel& model, double contact_force)
    : model_(&model), contact_force_(contact_force), kinematics_(model), outline_(model) {}

void StateEstimator::reset() {
  is_started_ = false;
  rest_time_ = 0;
  torso_velocity_in_odometry_.setZero();
  state_ = RobotState();
}

void StateEstimator::update(const Sensors& sensors, double dt) {
  state_.utime = sensors.utime;
  state_.tick = sensors.tick;
  state_.joint_position = sensors.position;
  state_.joint_velocity = sensors.velocity;
  kinematics_.update(sensors.position);
  watch_rest(sensors, dt);
  if (!is_started_) orientation_.reset(sensors.orientation_torso_in_world);
  orientation_.update(sensors.gyroscope_torso, sensors.accelerometer_torso,
                      rest_time_ > kSettlingTime, dt);
  state_.torso_in_odometry.linear() = orientation_.orientation().toRotationMatrix();
  state_.angular_velocity_torso = orientation_.angular_velocity();
  weigh_feet(sensors);
  stand_on_foot();
  measure_velocity(dt);
  find_support(sensors);
  is_started_ = true;
}

void StateEstimator::watch_rest(const Sensors& sensors, double dt) {
  bool is_at_rest =
      (sensors.gyroscope_torso - orientation_.bias()).cwiseAbs().maxCoeff() < kRestAngularVelocity;
  for (double velocity : sensors.velocity) {
    is_at_rest = is_at_rest && std::abs(velocity) < kRestJointVelocity;
  }
  rest_time_ = is_at_rest ? rest_time_ + dt : 0;
  state_.rest_time = rest_time_;
}

void StateEstimator::weigh_feet(const Sensors& sensors) {
  const size_t num_left = sensors.foot_force.size() / 2;
  state_.left_foot_force = 0;
  state_.right_foot_force = 0;
  for (size_t i = 0; i < sensors.foot_force.size(); ++i) {
    (i < num_left ? state_.left_foot_force : state_.right_foot_force) += sensors.foot_force[i];
  }
  const auto carries = [&](bool carried, double force) {
    return force > (carried ? contact_force_ : contact_force_ * kContactHysteresis);
  };
  state_.left_foot_carries = carries(state_.left_foot_carries, state_.left_foot_force);
  state_.right_foot_carries = carries(state_.right_foot_carries, state_.right_foot_force);
}

void StateEstimator::stand_on_foot() {
  const Eigen::Matrix3d& R_OT = state_.torso_in_odometry.linear();
  if (!is_started_) {
    stands_on_left_ = state_.left_foot_force >= state_.right_foot_force;
    standing_sole_in_odometry_ = (R_OT * sole(stands_on_left_).translation()).head<2>();
  }
  const double more_on_left = state_.left_foot_force - state_.right_foot_force;
  const bool other_stands =
      stands_on_left_ ? more_on_left < -kSwitchForce : more_on_left > kSwitchForce;
  if (other_stands) {
    const Eigen::Vector3d step =
        R_OT * (sole(!stands_on_left_).translation() - sole(stands_on_left_).translation());
    standing_sole_in_odometry_ += step.head<2>();
    stands_on_left_ = !stands_on_left_;
  }
  Eigen::Vector3d position = -(R_OT * sole(stands_on_left_).translation());
  position.head<2>() += standing_sole_in_odometry_;
  position.z() = -outline_.calc_lowest(kinematics_, R_OT);
  state_.torso_in_odometry.translation() = position;
  state_.center_of_mass_in_odometry = state_.torso_in_odometry * kinematics_.center_of_mass();
  state_.left_sole_in_odometry = state_.torso_in_odometry * kinematics_.left_sole();
  state_.right_sole_in_odometry = state_.torso_in_odometry * kinematics_.right_sole();
}

void StateEstimator::measure_velocity(double dt) {
  const Eigen::Vector3d position = state_.torso_in_odometry.translation();
  if (!is_started_) {
    torso_velocity_in_odometry_.setZero();
    state_.center_of_mass_velocity_in_odometry.setZero();
  } else if (dt > 0) {
    const double share = std::min(1.0, dt / kVelocityTimeConstant);
    torso_velocity_in_odometry_ +=
        share * ((position - last_torso_position_) / dt - torso_velocity_in_odometry_);
    state_.center_of_mass_velocity_in_odometry +=
        share * ((state_.center_of_mass_in_odometry - last_center_of_mass_) / dt -
                 state_.center_of_mass_velocity_in_odometry);
  }
  last_torso_position_ = position;
  last_center_of_mass_ = state_.center_of_mass_in_odometry;
  const Eigen::Matrix3d& R_OT = state_.torso_in_odometry.linear();
  const double heading = std::atan2(R_OT(1, 0), R_OT(0, 0));
  state_.velocity_torso_in_heading =
      Eigen::AngleAxisd(-heading, Eigen::Vector3d::UnitZ()) * torso_velocity_in_odometry_;
}

void StateEstimator::find_support(const Sensors& sensors) {
  std::vector<Eigen::Vector2d> corners;
  const auto add = [&](const std::vector<Eigen::Vector2d>& outline, const Eigen::Isometry3d& sole) {
    for (const Eigen::Vector2d& corner : outline) {
      corners.push_back((sole * Eigen::Vector3d(corner.x(), corner.y(), 0)).head<2>());
    }
  };
  if (state_.left_foot_carries) add(model_->left_sole_outline(), state_.left_sole_in_odometry);
  if (state_.right_foot_carries) add(model_->right_sole_outline(), state_.right_sole_in_odometry);
  state_.support_polygon_in_odometry = convex_hull(std::move(corners));
  state_.balance_margin = margin_in_polygon(state_.support_polygon_in_odometry,
                                            state_.center_of_mass_in_odometry.head<2>());

  double force_sum = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < sensors.foot_force.size(); ++i) {
    force_sum += sensors.foot_force[i];
    moment +=
        sensors.foot_force[i] * kinematics_.link_pose(model_->foot_sensors()[i]).translation();
  }
  if (state_.left_foot_carries || state_.right_foot_carries) {
    state_.center_of_pressure_in_odometry =
        (state_.torso_in_odometry * (moment / force_sum)).head<2>();
  } else {
    state_.center_of_pressure_in_odometry.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace nao::motion
