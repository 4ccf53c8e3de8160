#include "daemons/motion/estimator/state_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kinematics/pose2.h"
#include "kinematics/support_polygon.h"

namespace nao::motion {
namespace {

// Factor by which the force on a foot must exceed the contact threshold to make contact after none.
// Chosen: above the noise of the force sensors, so that the contact does not flicker.
constexpr double kContactHysteresis = 1.5;
// Velocities below which the robot rests, rad/s. Chosen: above the noise and bias of the gyroscope
// and of differentiated encoders, below any motion.
constexpr double kRestAngularVelocity = 0.06;
constexpr double kRestJointVelocity = 0.15;
// The first of these until the gyroscope's bias has been learnt, rad/s. Chosen: of 100 used robots
// that sway before they walk, 3 learnt a bias that tilted them by 5 degrees at 0.06, none at 0.03.
constexpr double kRestChange = 0.03;
// Time constant of the gyroscope's mean, s. Chosen: ten ticks, below the sway of a robot that comes
// to rest (0.4 s).
constexpr double kMeanRateTimeConstant = 0.1;
// Time constant of the velocity filter, s. Chosen: three periods of 10 ms, since differences of 0.1
// degree encoder steps over one period are noisy.
constexpr double kVelocityTimeConstant = 0.03;

/** Whether a link is fixed to, or moved by, the same foot as a sole: one of its ancestors is the
 * parent of the sole's frame. */
bool is_on_foot_of(const RobotModel& model, int link, int sole) {
  const int foot = model.joints()[model.links()[sole].parent_joint].parent_link;
  while (link != foot) {
    const int joint = model.links()[link].parent_joint;
    if (joint < 0) return false;
    link = model.joints()[joint].parent_link;
  }
  return true;
}

}  // namespace

StateEstimator::StateEstimator(const RobotModel& model)
    : model_(&model),
      contact_forces_(model.references().contact_forces),
      kinematics_(model),
      outline_(model) {
  bool has_right = false;
  bool has_left = false;
  // Forces of both feet come from one source: the sensors, if both feet have some.
  for (int link : model.foot_sensors()) {
    is_left_sensor_.push_back(is_on_foot_of(model, link, model.left_sole()));
    (is_left_sensor_.back() ? has_left : has_right) = true;
  }
  if (!has_left || !has_right) ground_reaction_.emplace(model);
}

void StateEstimator::reset() {
  is_started_ = false;
  rest_time_ = 0;
  torso_velocity_in_odometry_.setZero();
  state_ = RobotState();
  orientation_check_.reset();
}

void StateEstimator::update(const Sensors& sensors, double dt) {
  state_.utime = sensors.utime;
  state_.tick = sensors.tick;
  state_.joint_position = sensors.position;
  state_.joint_velocity = sensors.velocity;
  // Order: orientation needs rest, position needs orientation and support foot, velocity needs
  // position.
  kinematics_.update(sensors.position);
  detect_rest(sensors, dt);
  estimate_orientation(sensors, dt);
  measure_foot_forces(sensors);
  update_support_foot();
  estimate_position();
  estimate_velocity(dt);
  find_support(sensors);
  is_started_ = true;
}

void StateEstimator::detect_rest(const Sensors& sensors, double dt) {
  mean_rate_ += (sensors.gyroscope_torso - mean_rate_) * std::min(1.0, dt / kMeanRateTimeConstant);
  // Until the bias has been learnt, a robot rests whose rate does not change: gyroscopes of used
  // robots have offsets up to the greatest angular velocity of a rest.
  const bool has_bias = orientation_.has_learnt_bias();
  const Eigen::Vector3d& bias = has_bias ? orientation_.bias() : mean_rate_;
  const double greatest = has_bias ? kRestAngularVelocity : kRestChange;
  // Rest ends when the first axis of the gyroscope, or joint, moves.
  bool is_at_rest = (sensors.gyroscope_torso - bias).cwiseAbs().maxCoeff() < greatest &&
                    bias.cwiseAbs().maxCoeff() <= OrientationFilter::kMaxBias;
  for (double velocity : sensors.velocity) {
    is_at_rest = is_at_rest && std::abs(velocity) < kRestJointVelocity;
  }
  rest_time_ = is_at_rest ? rest_time_ + dt : 0;
}

void StateEstimator::estimate_orientation(const Sensors& sensors, double dt) {
  // Simulators and robots give an orientation; its first value is taken as a start, the later ones
  // are compared.
  if (!is_started_) orientation_.reset(sensors.orientation_torso_in_world);
  orientation_.update(sensors.gyroscope_torso, sensors.accelerometer_torso, rest_time_, dt);
  orientation_check_.update(sensors.orientation_torso_in_world, orientation_.orientation(), dt);
  state_.orientation_doubt = orientation_check_.doubt();
  state_.torso_in_odometry.linear() = orientation_.orientation().toRotationMatrix();
  state_.angular_velocity_torso = orientation_.angular_velocity();
}

void StateEstimator::measure_foot_forces(const Sensors& sensors) {
  state_.left_foot_force = 0;
  state_.right_foot_force = 0;
  if (ground_reaction_) {
    const Eigen::Vector3d up = state_.torso_in_odometry.linear().row(2);
    reactions_ = ground_reaction_->estimate(kinematics_, sensors.torque, up);
    state_.left_foot_force = reactions_[0].force;
    state_.right_foot_force = reactions_[1].force;
  } else {
    for (size_t i = 0; i < sensors.foot_force.size(); ++i) {
      (is_left_sensor_[i] ? state_.left_foot_force : state_.right_foot_force) +=
          sensors.foot_force[i];
    }
  }
  // Hysteresis: the force at which contact is made is larger than that at which it is lost.
  const auto carries = [&](bool carried, double force) {
    const double least = contact_forces_.contact;
    return force > (carried ? least : least * kContactHysteresis);
  };
  state_.left_foot_carries = carries(state_.left_foot_carries, state_.left_foot_force);
  state_.right_foot_carries = carries(state_.right_foot_carries, state_.right_foot_force);
}

void StateEstimator::update_support_foot() {
  const Eigen::Matrix3d& R_OT = state_.torso_in_odometry.linear();
  if (!is_started_) {
    is_left_support_ = state_.left_foot_force >= state_.right_foot_force;
    // The support sole is under the torso by forward kinematics; odometry begins at the torso.
    support_sole_in_odometry_ = (R_OT * sole(is_left_support_).translation()).head<2>();
  }
  const double more_on_left = state_.left_foot_force - state_.right_foot_force;
  const bool is_other_support = is_left_support_ ? more_on_left < -contact_forces_.support_switch
                                                 : more_on_left > contact_forces_.support_switch;
  if (!is_other_support) return;
  // Vector between the soles in odometry: the new support sole is placed where kinematics says it
  // is now. Odometry is this sum over all steps; slip of a foot is not measured.
  const Eigen::Vector3d step =
      R_OT * (sole(!is_left_support_).translation() - sole(is_left_support_).translation());
  support_sole_in_odometry_ += step.head<2>();
  is_left_support_ = !is_left_support_;
}

void StateEstimator::estimate_position() {
  const Eigen::Matrix3d& R_OT = state_.torso_in_odometry.linear();
  // The support sole is fixed in odometry, so that the torso is where the kinematic chain from that
  // sole ends. The height is the lowest point of the body on the floor.
  Eigen::Vector3d position = -(R_OT * sole(is_left_support_).translation());
  position.head<2>() += support_sole_in_odometry_;
  position.z() = -outline_.calc_lowest(kinematics_, R_OT);
  state_.torso_in_odometry.translation() = position;
  state_.center_of_mass_in_odometry = state_.torso_in_odometry * kinematics_.center_of_mass();
  state_.left_sole_in_odometry = state_.torso_in_odometry * kinematics_.left_sole();
  state_.right_sole_in_odometry = state_.torso_in_odometry * kinematics_.right_sole();
}

void StateEstimator::estimate_velocity(double dt) {
  const Eigen::Vector3d position = state_.torso_in_odometry.translation();
  if (!is_started_) {
    torso_velocity_in_odometry_.setZero();
    state_.center_of_mass_velocity_in_odometry.setZero();
  } else if (dt > 0) {
    // Difference quotients through a first-order low-pass filter.
    const double weight = std::min(1.0, dt / kVelocityTimeConstant);
    torso_velocity_in_odometry_ +=
        weight * ((position - last_torso_position_) / dt - torso_velocity_in_odometry_);
    state_.center_of_mass_velocity_in_odometry +=
        weight * ((state_.center_of_mass_in_odometry - last_center_of_mass_) / dt -
                  state_.center_of_mass_velocity_in_odometry);
  }
  last_torso_position_ = position;
  last_center_of_mass_ = state_.center_of_mass_in_odometry;
  const Eigen::Matrix3d& R_OT = state_.torso_in_odometry.linear();
  const double heading = heading_of(R_OT);
  // The heading frame is the one in which a joystick commands velocities.
  state_.velocity_torso_in_heading =
      Eigen::AngleAxisd(-heading, Eigen::Vector3d::UnitZ()) * torso_velocity_in_odometry_;
}

std::vector<Eigen::Vector2d> calc_support_polygon(const RobotModel& model,
                                                  const RobotState& state) {
  std::vector<Eigen::Vector2d> corners;
  const auto add = [&](const std::vector<Eigen::Vector2d>& outline, const Eigen::Isometry3d& sole) {
    for (const Eigen::Vector2d& corner : outline) {
      corners.push_back((sole * Eigen::Vector3d(corner.x(), corner.y(), 0)).head<2>());
    }
  };
  if (state.left_foot_carries) add(model.left_sole_outline(), state.left_sole_in_odometry);
  if (state.right_foot_carries) add(model.right_sole_outline(), state.right_sole_in_odometry);
  return convex_hull(std::move(corners));
}

void StateEstimator::find_support(const Sensors& sensors) {
  state_.support_polygon_in_odometry = calc_support_polygon(*model_, state_);
  state_.balance_margin = margin_in_polygon(state_.support_polygon_in_odometry,
                                            state_.center_of_mass_in_odometry.head<2>());

  if (state_.left_foot_carries || state_.right_foot_carries) {
    state_.center_of_pressure_in_odometry =
        (state_.torso_in_odometry * calc_center_of_pressure(sensors)).head<2>();
  } else {
    // Without contact there is no center of pressure, which NaN tells all users.
    state_.center_of_pressure_in_odometry.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

// In the torso frame: the mean of the sensors' positions, or of the feet's centers of pressure,
// weighted by force.
Eigen::Vector3d StateEstimator::calc_center_of_pressure(const Sensors& sensors) const {
  double force_sum = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  if (ground_reaction_) {
    for (const FootReaction& reaction : reactions_) {
      force_sum += reaction.force;
      moment += reaction.force * reaction.point;
    }
  } else {
    for (size_t i = 0; i < sensors.foot_force.size(); ++i) {
      force_sum += sensors.foot_force[i];
      moment +=
          sensors.foot_force[i] * kinematics_.link_pose(model_->foot_sensors()[i]).translation();
    }
  }
  return moment / force_sum;
}

}  // namespace nao::motion
