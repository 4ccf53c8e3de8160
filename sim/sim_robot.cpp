#include "sim/sim_robot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** A motor that uses this share of its torque gets a bound in the solver beforehand. */
constexpr double kBoundShare = 0.8;
/** Share of the limit by which a motor may exceed it before a step is solved anew. */
constexpr double kBoundTolerance = 1e-3;
/** Nothing that the robot can do brings it near these: rad/s, m/s, m. */
constexpr double kGreatestRate = 300;
constexpr double kGreatestSpeed = 100;
constexpr double kFarthest = 1000;

SensorOptions sensor_options(const RobotOptions& options) {
  SensorOptions result;
  result.is_ideal = options.ideal_sensors;
  return result;
}

uint64_t seed_of(const WorldOptions& world, const std::string& name) {
  // FNV-1a: robots of one world differ in their noise.
  uint64_t hash = 14695981039346656037u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash ^ (world.seed * 0x9e3779b97f4a7c15u);
}

}  // namespace

SimRobot::SimRobot(std::shared_ptr<const RobotModel> model, const RobotOptions& options,
                   const WorldOptions& world)
    : model_(std::move(model)),
      options_(options),
      tree_(*model_, options.mass_scale),
      state_(tree_.num_dofs()),
      dynamics_(tree_, options.is_on_stand),
      collisions_(*model_, tree_, world.num_sole_points),
      sensors_(*model_, sensor_options(options), seed_of(world, options.name)),
      gravity_(world.gravity),
      floor_slots_(collisions_.points.size()),
      self_slots_(collisions_.self_pairs.size()) {
  const int num_dofs = tree_.num_dofs();
  const int num_motors = model_->num_motors();
  motor_of_dof_.assign(num_dofs, -1);
  for (int i = 0; i < num_motors; ++i) {
    Drive drive;
    drive.motor = model_->motor(i);
    drive.motor.peak_torque *= options.torque_scale;
    drive.motor.continuous_torque *= options.torque_scale;
    const Joint& joint = model_->motor_joint(i);
    drive.lower = joint.lower;
    drive.upper = joint.upper;
    drive.max_velocity = joint.max_velocity;
    for (int body = 1; body < tree_.num_bodies(); ++body) {
      if (tree_.bodies()[body].joint == model_->motors()[i]) {
        drive.dof = tree_.bodies()[body].dof;
        motor_of_dof_[drive.dof] = i;
      }
    }
    drives_.push_back(drive);
  }
  targets_.position = Eigen::VectorXd::Zero(num_motors);
  targets_.stiffness = Eigen::VectorXd::Ones(num_motors);
  delayed_targets_.assign(static_cast<size_t>(options.command_latency_ticks) + 1, targets_);
  for (Eigen::VectorXd* vector : {&external_impulse_, &bias_, &diagonal_, &work_, &momentum_}) {
    *vector = Eigen::VectorXd::Zero(num_dofs);
  }
  for (Eigen::VectorXd* vector :
       {&motor_position_, &motor_velocity_, &motor_torque_, &torque_sum_}) {
    *vector = Eigen::VectorXd::Zero(num_motors);
  }
  entry_of_dof_.assign(num_dofs, -1);
  position_.assign(num_dofs, -1);

  return_to_start();
  switch_on();
}

SimRobot::~SimRobot() = default;

Eigen::Isometry3d SimRobot::link_pose(int link) const {
  Eigen::Isometry3d pose = dynamics_.pose(tree_.body_of_link(link)) * tree_.pose_in_body(link);
  const int joint = model_->links()[link].parent_joint;
  for (const Drive& drive : drives_) {
    if (drive.dof >= 0 || joint < 0) continue;
    const int motor = static_cast<int>(&drive - drives_.data());
    if (model_->motors()[motor] != joint) continue;
    pose = pose * Eigen::AngleAxisd(drive.opening, model_->joints()[joint].axis);
  }
  return pose;
}

Quaterniond SimRobot::resting_orientation(const Posture* posture) const {
  if (posture == nullptr) return Quaterniond::Identity();
  if (posture->family == "lying-back") {
    return Quaterniond(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitY()));
  }
  if (posture->family == "lying-belly") {
    return Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitY()));
  }
  if (posture->family == "sitting") return sitting_orientation(*posture);
  if (model_->left_sole() < 0) return Quaterniond::Identity();
  // The torso leans so that the left sole is level.
  const Matrix3d sole = model_->link_poses(posture->position)[model_->left_sole()].linear();
  const Vector3d up_in_torso = sole.col(2);
  return Quaterniond::FromTwoVectors(up_in_torso, Vector3d::UnitZ());
}

Quaterniond SimRobot::sitting_orientation(const Posture& posture) const {
  // Of all ways to lean back or forward, the one with the lowest centre of mass is where it comes
  // to rest.
  std::vector<Vector3d> points;
  std::vector<double> radii;
  const std::vector<Eigen::Isometry3d> poses = model_->link_poses(posture.position);
  for (const CollisionModel::Part& part : collisions_.parts) {
    const int body_link = tree_.bodies()[part.body].joint < 0
                              ? 0
                              : model_->joints()[tree_.bodies()[part.body].joint].child_link;
    for (int i = part.first_point; i < part.end_point; ++i) {
      points.push_back(poses[body_link] * collisions_.points[i].center_in_body);
      radii.push_back(collisions_.points[i].radius);
    }
  }
  Vector3d center = Vector3d::Zero();
  for (size_t i = 0; i < poses.size(); ++i) {
    center += model_->links()[i].mass * (poses[i] * model_->links()[i].center_of_mass);
  }
  center /= model_->total_mass();
  Quaterniond best = Quaterniond::Identity();
  double least = kInfinity;
  for (double pitch = -0.8; pitch <= 0.8; pitch += 0.005) {
    const Quaterniond leaning(Eigen::AngleAxisd(pitch, Vector3d::UnitY()));
    double lowest = kInfinity;
    for (size_t i = 0; i < points.size(); ++i) {
      lowest = std::min(lowest, (leaning * points[i]).z() - radii[i]);
    }
    const double height = (leaning * center).z() - lowest;
    if (height >= least) continue;
    least = height;
    best = leaning;
  }
  return best;
}

double SimRobot::lowest_point() const {
  double lowest = kInfinity;
  for (const CollisionModel::Part& part : collisions_.parts) {
    for (int i = part.first_point; i < part.end_point; ++i) {
      const CollisionModel::Point& point = collisions_.points[i];
      const Vector3d in_world =
          dynamics_.position(part.body) + dynamics_.rotation(part.body) * point.center_in_body;
      lowest = std::min(lowest, in_world.z() - point.radius);
    }
  }
  return std::isfinite(lowest) ? lowest : 0;
}

void SimRobot::place(const std::vector<double>& position, const Vector3d& ground_position,
                     const Quaterniond& orientation) {
  state_.velocity.setZero();
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    drive.opening = position[i];
    if (drive.dof >= 0) state_.coordinate[drive.dof] = position[i];
    drive.stop_impulse = drive.friction_impulse = drive.upper_impulse = drive.lower_impulse = 0;
    targets_.position[static_cast<long>(i)] = position[i];
  }
  std::fill(delayed_targets_.begin(), delayed_targets_.end(), targets_);
  last_aim_ = targets_.position;
  root_change_ = {};
  std::fill(floor_slots_.begin(), floor_slots_.end(), ContactSlot());
  std::fill(self_slots_.begin(), self_slots_.end(), ContactSlot());
  external_impulse_.setZero();
  state_.orientation = orientation.normalized();
  state_.position = {ground_position.x(), ground_position.y(), 0};
  dynamics_.update_kinematics(state_);
  state_.position.z() = ground_position.z() - lowest_point();
  dynamics_.update_kinematics(state_);
  motor_torque_.setZero();
  update_motor_arrays();
  begin_tick();
  sensors_.jump(update_truth());
}

void SimRobot::return_to_start() {
  const Posture* posture = model_->find_posture(options_.posture);
  if (posture == nullptr) {
    throw ConfigError("robot " + model_->name() + " has no posture \"" + options_.posture + "\"");
  }
  const Quaterniond heading(Eigen::AngleAxisd(options_.heading, Vector3d::UnitZ()));
  place(posture->position, {options_.position.x(), options_.position.y(), options_.height},
        heading * resting_orientation(posture));
}

void SimRobot::switch_on() {
  num_ticks_ = 0;
  targets_.stiffness.setOnes();
  std::fill(delayed_targets_.begin(), delayed_targets_.end(), targets_);
  for (Drive& drive : drives_) drive.heat = 0;
  sensors_.reset(update_truth());
}

void SimRobot::update_motor_arrays() {
  for (size_t i = 0; i < drives_.size(); ++i) {
    const Drive& drive = drives_[i];
    const auto k = static_cast<long>(i);
    motor_position_[k] = drive.dof < 0 ? drive.opening : state_.coordinate[drive.dof];
    motor_velocity_[k] = drive.dof < 0 ? 0 : state_.velocity[drive.dof];
  }
}

void SimRobot::begin_tick() {
  torque_sum_.setZero();
  specific_force_sum_.setZero();
  angular_velocity_sum_.setZero();
  foot_impulse_ = {};
  tick_time_ = 0;
  const int accelerometer = model_->accelerometer();
  accelerometer_velocity_ = accelerometer < 0
                                ? Vector3d::Zero()
                                : dynamics_.velocity_at(0, link_pose(accelerometer).translation());
}

void SimRobot::begin_step(double h, Eigen::Ref<Eigen::VectorXd> z) {
  dynamics_.update_mass_matrix();
  dynamics_.calc_bias(gravity_, bias_);
  work_ = state_.velocity;
  if (!options_.is_on_stand) {
    // What Coriolis forces do to the root's own motion is in end_step()'s taking the momentum over
    // to the new configuration, so it is taken back here; what they do to the joints stays.
    const Vector3d weight = tree_.total_mass() * gravity_;
    const Vector3d arm = dynamics_.center_of_mass_from_origin();
    const SpatialVector back =
        dynamics_.rigid_motion({bias_.head<3>() + arm.cross(weight), bias_.segment<3>(3) + weight});
    work_.head<3>() += h * back.angular;
    work_.segment<3>(3) += h * back.linear;
  }
  dynamics_.multiply_by_mass(work_, momentum_);
  momentum_ += external_impulse_ - h * bias_;
  if (options_.is_on_stand) momentum_.head<6>().setZero();
  diagonal_.setZero();
  const MotorTargets& targets =
      delayed_targets_[static_cast<size_t>(num_ticks_) % delayed_targets_.size()];
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.dof < 0) continue;
    const auto k = static_cast<long>(i);
    const double speed = state_.velocity[drive.dof];
    // Speeds belong to the middle between two steps: half of this one's torque falls before now.
    const double aim = (last_aim_[k] + targets.position[k]) / 2;
    drive.plan(h, targets.stiffness[k], aim - state_.coordinate[drive.dof], speed);
    drive.stop_row = drive.friction_row = drive.upper_row = drive.lower_row = -1;
    const double inertia = drive.motor.reflected_inertia;
    diagonal_[drive.dof] = inertia + h * (drive.slope + drive.line + drive.viscosity);
    momentum_[drive.dof] += inertia * speed + h * (drive.demand - drive.emf - drive.drag);
  }
  last_aim_ = targets.position;
  external_impulse_.setZero();
  is_touched_ = false;
  dynamics_.factorize(diagonal_);
  dynamics_.solve_upper(momentum_);
  z = momentum_;
  std::fill(entry_of_dof_.begin(), entry_of_dof_.end(), -1);
}

int SimRobot::add_dof_entries(int dof, ConstraintSolver& solver, int first_dof) {
  if (entry_of_dof_[dof] >= 0) return entry_of_dof_[dof];
  const std::vector<int>& above = tree_.dof_ancestors(dof);
  const int count = static_cast<int>(above.size()) + 1;
  const int first = solver.add_entries(count);
  if (first < 0) return -1;
  const std::vector<int>& chain = tree_.bodies()[tree_.body_of_dof(dof)].chain;
  for (int k = 0; k < count; ++k) {
    solver.dof(first + k) = first_dof + chain[k];
    solver.entry(first + k) = RowEntry();
    position_[chain[k]] = k;
  }
  solver.entry(first + count - 1).row[0] = 1;
  dynamics_.solve_upper(chain.data(), count, position_.data(), &solver.entry(first));
  entry_of_dof_[dof] = first;
  return first;
}

void SimRobot::add_motor_bound(int motor, bool is_upper, bool is_braking, double h,
                               ConstraintSolver& solver, int first_dof) {
  Drive& drive = drives_[motor];
  const int first = add_dof_entries(drive.dof, solver, first_dof);
  if (first < 0) return;
  // The torque in question is demand - slope * speed: u itself, or u less back-EMF when braking.
  const double slope = drive.slope + (is_braking ? drive.line : 0);
  const double demand = drive.demand - (is_braking ? drive.emf : 0);
  JointRow row;
  row.first_entry = first;
  row.num_entries = static_cast<int>(tree_.dof_ancestors(drive.dof).size()) + 1;
  row.apply = is_upper ? -1 : 1;
  row.measure = is_upper ? 1 : -1;
  row.softness = 1 / (h * slope);
  row.bias = (is_upper ? drive.limit - demand : drive.limit + demand) / slope;
  row.upper = kInfinity;
  row.impulse = is_upper ? drive.upper_impulse : drive.lower_impulse;
  int& index = is_upper ? drive.upper_row : drive.lower_row;
  if (index < 0) {
    index = solver.add_row(row);
  } else {
    solver.replace_row(index, row);
  }
  (is_upper ? drive.is_upper_braking : drive.is_lower_braking) = is_braking;
}

void SimRobot::add_joint_rows(double h, ConstraintSolver& solver, int first_dof) {
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.dof < 0) continue;
    const double angle = state_.coordinate[drive.dof];
    const double speed = state_.velocity[drive.dof];
    const int count = static_cast<int>(tree_.dof_ancestors(drive.dof).size()) + 1;

    if (drive.motor.dry_friction > 0) {
      const int first = add_dof_entries(drive.dof, solver, first_dof);
      JointRow row;
      row.first_entry = first;
      row.num_entries = count;
      row.upper = h * drive.motor.dry_friction;
      row.lower = -row.upper;
      row.impulse = drive.friction_impulse;
      if (first >= 0) drive.friction_row = solver.add_row(row);
    }
    const double to_lower = angle - drive.lower;
    const double to_upper = drive.upper - angle;
    const bool is_low = to_lower < to_upper;
    const double distance = is_low ? to_lower : to_upper;
    const double approach = is_low ? -speed : speed;
    if (distance < 0.01 + 2 * h * approach) {
      const int first = add_dof_entries(drive.dof, solver, first_dof);
      const double strength = h * kStopStiffness + kStopDamping;
      JointRow row;
      row.first_entry = first;
      row.num_entries = count;
      row.apply = row.measure = is_low ? 1 : -1;
      row.softness = 1 / (h * strength);
      row.bias = distance > 0 ? distance / h : kStopStiffness * distance / strength;
      row.upper = kInfinity;
      row.impulse = drive.stop_impulse;
      if (first >= 0) drive.stop_row = solver.add_row(row);
    } else {
      drive.stop_impulse = 0;
    }
    const double wished = drive.demand - drive.slope * speed;
    if (drive.slope > 0) {
      const double threshold = kBoundShare * drive.limit;
      if (wished > threshold || drive.upper_impulse > 0) {
        add_motor_bound(static_cast<int>(i), true, speed < 0, h, solver, first_dof);
      }
      if (wished < -threshold || drive.lower_impulse > 0) {
        add_motor_bound(static_cast<int>(i), false, speed > 0, h, solver, first_dof);
      }
    }
  }
}

bool SimRobot::add_missed_bounds(double h, const Eigen::VectorXd& z, ConstraintSolver& solver,
                                 int first_dof) {
  work_ = z.segment(first_dof, tree_.num_dofs());
  dynamics_.solve_lower(work_);
  bool has_changed = false;
  const auto impulse_of = [&](int row) { return row < 0 ? 0.0 : solver.rows()[row].impulse; };
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.dof < 0 || drive.slope == 0) continue;
    const double speed = work_[drive.dof];
    const double driven = drive.demand - drive.slope * speed +
                          (impulse_of(drive.lower_row) - impulse_of(drive.upper_row)) / h;
    const double allowed = drive.limit * (1 + kBoundTolerance);
    const double back_emf = drive.emf + drive.line * speed;
    for (const bool is_upper : {true, false}) {
      // Driving, the driver's share is bounded; braking, the torque itself.
      const bool is_braking = is_upper ? back_emf < 0 : back_emf > 0;
      const double bounded = driven - (is_braking ? back_emf : 0);
      if (is_upper ? bounded <= allowed : bounded >= -allowed) continue;
      const int row = is_upper ? drive.upper_row : drive.lower_row;
      if (row >= 0 && (is_upper ? drive.is_upper_braking : drive.is_lower_braking) == is_braking) {
        continue;  // Bounded already: within the solver's tolerance.
      }
      if (row < 0) (is_upper ? drive.upper_impulse : drive.lower_impulse) = 0;
      add_motor_bound(static_cast<int>(i), is_upper, is_braking, h, solver, first_dof);
      has_changed = true;
    }
  }
  return has_changed;
}

void SimRobot::take_velocities() {
  state_.velocity = work_;
  dynamics_.update_velocities(state_);
}

void SimRobot::end_step(double h, const ConstraintSolver& solver) {
  const auto first_of = [&](int row) { return row < 0 ? 0.0 : solver.rows()[row].impulse; };
  const Vector3d accelerometer =
      model_->accelerometer() < 0
          ? Vector3d::Zero()
          : Vector3d(tree_.pose_in_body(model_->accelerometer()).translation());
  SpatialVector momentum = dynamics_.momentum();
  momentum.angular -= dynamics_.center_of_mass_from_origin().cross(momentum.linear);
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.dof < 0) continue;
    const double speed = state_.velocity[drive.dof];
    state_.coordinate[drive.dof] += h * speed;
    drive.stop_impulse = first_of(drive.stop_row);
    drive.friction_impulse = first_of(drive.friction_row);
    drive.upper_impulse = first_of(drive.upper_row);
    drive.lower_impulse = first_of(drive.lower_row);
    const double torque = drive.demand - drive.emf - (drive.slope + drive.line) * speed +
                          (drive.lower_impulse - drive.upper_impulse) / h;
    motor_torque_[static_cast<long>(i)] = torque;
    torque_sum_[static_cast<long>(i)] += h * torque;
  }
  // In flight the root moves as the momentum wants it in the configuration half-way: with half the
  // change of velocity that the new one will bring, which is about the last step's. Where contacts
  // push, that could add energy.
  if (is_touched_) root_change_ = {};
  state_.position += h * (state_.velocity.segment<3>(3) + root_change_.linear / 2);
  const Vector3d turn = h * (state_.velocity.head<3>() + root_change_.angular / 2);
  const double angle = turn.norm();
  if (angle > 0) {
    // Exponential map; sin(x/2)/x in its series for small x.
    const double half = angle / 2;
    const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48 : std::sin(half) / angle;
    const Vector3d v = scale * turn;
    state_.orientation = Quaterniond(std::cos(half), v.x(), v.y(), v.z()) * state_.orientation;
    state_.orientation.normalize();
  }
  dynamics_.update_kinematics(state_);
  if (!options_.is_on_stand) {
    // The same speeds in the new configuration would be another momentum.
    momentum.angular += dynamics_.center_of_mass_from_origin().cross(momentum.linear);
    root_change_ = dynamics_.set_momentum(momentum, state_.velocity);
  }

  const Matrix3d to_torso = dynamics_.rotation(0).transpose();
  const Vector3d velocity =
      dynamics_.velocity_at(0, dynamics_.position(0) + dynamics_.rotation(0) * accelerometer);
  specific_force_sum_ += to_torso * (velocity - accelerometer_velocity_);
  accelerometer_velocity_ = velocity;
  angular_velocity_sum_ += h * (to_torso * state_.velocity.head<3>());
  tick_time_ += h;
}

const TrueMotion& SimRobot::update_truth() {
  truth_.position = motor_position_;
  truth_.torque = motor_torque_;
  truth_.orientation = state_.orientation;
  truth_.specific_force = -(dynamics_.rotation(0).transpose() * gravity_);
  truth_.angular_velocity.setZero();
  truth_.feet = {};
  if (tick_time_ > 0) {
    truth_.torque = torque_sum_ / tick_time_;
    truth_.specific_force += specific_force_sum_ / tick_time_;
    truth_.angular_velocity = angular_velocity_sum_ / tick_time_;
    for (int side = 0; side < 2; ++side) {
      truth_.feet[side].force = foot_impulse_[side].force / tick_time_;
      truth_.feet[side].moment = foot_impulse_[side].moment / tick_time_;
    }
  }
  return truth_;
}

void SimRobot::end_tick(double period) {
  const MotorTargets& targets =
      delayed_targets_[static_cast<size_t>(num_ticks_) % delayed_targets_.size()];
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    const auto k = static_cast<long>(i);
    if (drive.dof >= 0) {
      drive.warm_up(torque_sum_[k] / period, period);
    } else if (targets.stiffness[k] > 0) {
      // An opening follows its target in 0.1 s, at its greatest speed when far.
      const double error =
          std::clamp(targets.position[k], drive.lower, drive.upper) - drive.opening;
      const double speed = std::clamp(error / 0.1, -drive.max_velocity, drive.max_velocity);
      drive.opening += speed * period;
    }
  }
  ++num_ticks_;
  update_motor_arrays();
  sensors_.update(update_truth(), period);
}

void SimRobot::add_impulse(int body_index, const Vector3d& impulse) {
  const Vector3d point = dynamics_.body_center_of_mass(body_index);
  external_impulse_.head<3>() += (point - dynamics_.origin()).cross(impulse);
  external_impulse_.segment<3>(3) += impulse;
  const Vector3d moment = (point - dynamics_.origin()).cross(impulse);
  for (int i = body_index; i > 0; i = tree_.bodies()[i].parent) {
    const SpatialVector& motion = dynamics_.motion(i);
    external_impulse_[tree_.bodies()[i].dof] +=
        motion.angular.dot(moment) + motion.linear.dot(impulse);
  }
}

void SimRobot::add_foot_load(int sole, const Vector3d& point, const Vector3d& impulse) {
  const int link = sole == 0 ? model_->left_sole() : model_->right_sole();
  const Eigen::Isometry3d& sole_in_body = tree_.pose_in_body(link);
  const int body = tree_.body_of_link(link);
  const Matrix3d to_sole = (dynamics_.rotation(body) * sole_in_body.linear()).transpose();
  const Vector3d origin =
      dynamics_.position(body) + dynamics_.rotation(body) * sole_in_body.translation();
  const double force = to_sole.row(2).dot(impulse);
  const Vector3d place = to_sole * (point - origin);
  foot_impulse_[sole].force += force;
  foot_impulse_[sole].moment += force * place.head<2>();
}

double SimRobot::energy() const {
  double sum =
      dynamics_.kinetic_energy() + tree_.total_mass() * -gravity_.dot(dynamics_.center_of_mass());
  for (const Drive& drive : drives_) {
    if (drive.dof < 0) continue;
    const double speed = state_.velocity[drive.dof];
    const double angle = state_.coordinate[drive.dof];
    const double bent = std::max({0.0, drive.lower - angle, angle - drive.upper});
    sum += 0.5 * drive.motor.reflected_inertia * speed * speed + 0.5 * kStopStiffness * bent * bent;
  }
  return sum;
}

bool SimRobot::is_sane() const {
  if (!state_.velocity.allFinite() || !state_.coordinate.allFinite() ||
      !state_.position.allFinite() || !state_.orientation.coeffs().allFinite()) {
    return false;
  }
  const double rate = std::max(state_.velocity.head<3>().cwiseAbs().maxCoeff(),
                               state_.velocity.tail(tree_.num_dofs() - 6).cwiseAbs().maxCoeff());
  const double speed = state_.velocity.segment<3>(3).cwiseAbs().maxCoeff();
  return rate < kGreatestRate && speed < kGreatestSpeed &&
         state_.position.cwiseAbs().maxCoeff() < kFarthest && state_.position.z() > -0.2;
}

}  // namespace nao::sim
