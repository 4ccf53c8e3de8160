#include "daemons/motion/estimator/ground_reaction.h"

#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "common/linear_solver.h"

namespace nao::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;
using Block12d = Eigen::Matrix<double, 3, 12>;

// Standard deviations of the equations' errors. Chosen: a joint's torque, 3 % of its peak, is twice
// the dry friction of a geared motor; the body's acceleration is a quarter of gravity in a walk,
// and its moments are those of a force 5 % of its height off the center of mass.
constexpr double kTorqueError = 0.03;
constexpr double kForceError = 0.25;
constexpr double kMomentError = 0.05;
// Expected forces and moments on a foot, as fractions of the weight, and of the weight
// times the height: on a foot that may stand they only keep the equations solvable.
constexpr double kExpectedForce = 2;
constexpr double kExpectedMoment = 1;
// Height of a foot above the other one, as a fraction of the robot's height, at which the expected
// forces and moments are e^-1 of these; and their least fraction. Chosen: joint zeros and backlash
// of half a degree in each joint of a leg displace its foot by 1 % of the height.
constexpr double kLiftedHeight = 0.02;
constexpr double kLiftedFraction = 0.005;
// A foot with less of the weight than this has no center of pressure.
constexpr double kLeastReaction = 1e-3;

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/** Normal equations of weighted least squares. */
struct NormalEquations {
  Matrix12d matrix = Matrix12d::Zero();
  Vector12d right_side = Vector12d::Zero();

  /** Adds row . x = value with a standard deviation. */
  void add(const Vector12d& row, double value, double deviation) {
    const double weight = 1 / (deviation * deviation);
    matrix += weight * row * row.transpose();
    right_side += weight * value * row;
  }
  void add(const Block12d& rows, const Vector3d& value, double deviation) {
    const double weight = 1 / (deviation * deviation);
    matrix += weight * rows.transpose() * rows;
    right_side += weight * rows.transpose() * value;
  }
};

}  // namespace

GroundReaction::GroundReaction(const RobotModel& model)
    : model_(&model), weight_(model.total_mass() * kGravity) {
  for (const LegDescription& leg : model.legs()) {
    for (const int joint : leg.joints) {
      const int motor = model.motor_of(joint);
      if (motor >= 0 && std::find(motors_.begin(), motors_.end(), motor) == motors_.end()) {
        motors_.push_back(motor);
      }
    }
  }
  const Kinematics kinematics(model);
  height_ = kinematics.left_sole().inverse().translation().norm();
  for (size_t i = 0; i < soles_.size(); ++i) {
    for (const Eigen::Vector2d& corner : model.legs()[i].outline) soles_[i].extend(corner);
  }
}

std::array<FootReaction, 2> GroundReaction::estimate(const Kinematics& kinematics,
                                                     const std::vector<double>& torque,
                                                     const Vector3d& up) const {
  const std::array<Eigen::Isometry3d, 2> soles = {kinematics.left_sole(), kinematics.right_sole()};
  const std::array<int, 2> links = {model_->left_sole(), model_->right_sole()};
  NormalEquations equations;

  // Unknowns: force and moment on the left sole, then on the right one, in the torso frame.
  Eigen::Matrix<double, 12, Eigen::Dynamic> jacobian(12, model_->num_motors());
  for (int i = 0; i < 2; ++i) {
    jacobian.middleRows<3>(6 * i) =
        kinematics.calc_point_jacobian(links[i], soles[i].translation());
    jacobian.middleRows<3>(6 * i + 3) = kinematics.calc_angular_jacobian(links[i]);
  }
  const Eigen::RowVectorXd gravity =
      weight_ * up.transpose() * kinematics.calc_center_of_mass_jacobian();
  for (const int motor : motors_) {
    equations.add(Vector12d(jacobian.col(motor)), gravity[motor] - torque[motor],
                  kTorqueError * model_->motor_joint(motor).max_torque);
  }

  Block12d forces = Block12d::Zero();
  Block12d moments = Block12d::Zero();
  for (int i = 0; i < 2; ++i) {
    forces.middleCols<3>(6 * i).setIdentity();
    moments.middleCols<3>(6 * i) =
        cross_matrix(soles[i].translation() - kinematics.center_of_mass());
    moments.middleCols<3>(6 * i + 3).setIdentity();
  }
  equations.add(forces, weight_ * up, kForceError * weight_);
  equations.add(moments, Vector3d::Zero(), kMomentError * weight_ * height_);
  const double lead = (soles[0].translation() - soles[1].translation()).dot(up);
  for (int k = 0; k < 12; ++k) {
    const double lift = std::max(0.0, k < 6 ? lead : -lead) / (kLiftedHeight * height_);
    const double expected = std::max(kLiftedFraction, std::exp(-lift * lift));
    const double scale = k % 6 < 3 ? kExpectedForce : kExpectedMoment * height_;
    equations.add(Vector12d(Vector12d::Unit(k)), 0, expected * scale * weight_);
  }
  solve_positive_definite(equations.matrix, equations.right_side);
  const Vector12d& solution = equations.right_side;

  std::array<FootReaction, 2> reactions;
  for (int i = 0; i < 2; ++i) {
    FootReaction& reaction = reactions[i];
    reaction.point = soles[i].translation();
    reaction.force = std::max(0.0, solution.segment<3>(6 * i).dot(up));
    const Vector3d force = soles[i].linear().transpose() * solution.segment<3>(6 * i);
    if (reaction.force < kLeastReaction * weight_ || force.z() < kLeastReaction * weight_) continue;
    const Vector3d moment = soles[i].linear().transpose() * solution.segment<3>(6 * i + 3);
    // Point of the sole about which the moment has no horizontal part.
    const Eigen::Vector2d pressure = Eigen::Vector2d(-moment.y(), moment.x()) / force.z();
    const Eigen::Vector2d inside = pressure.cwiseMax(soles_[i].min()).cwiseMin(soles_[i].max());
    reaction.point = soles[i] * Vector3d(inside.x(), inside.y(), 0);
  }
  return reactions;
}

}  // namespace nao::motion
