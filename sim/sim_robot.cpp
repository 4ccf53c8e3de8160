#include "sim/sim_robot.h"

#include <string>

#include "common/error.h"
#include "sim/placement.h"

namespace nao::sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/** Parameters of a drag: time for which one command acts, s (world_command_t); stiffness, N/m;
 * damping, N s/m; and greatest force, N. Chosen: a limp arm hangs 1 cm below the target and does
 * not swing, and a standing robot is not pulled over at once. The damping is stable with steps of 2
 * ms down to a mass of 16 g. */
constexpr double kDragTime = 0.2;
constexpr double kDragStiffness = 400;
constexpr double kDragDamping = 8;
constexpr double kMaxDragForce = 20;

SensorOptions sensor_options(const RobotOptions& options) {
  SensorOptions result;
  result.is_ideal = options.ideal_sensors;
  result.errors = options.errors;
  return result;
}

/** Seed of a robot's noise: robots of one world have different noise. */
uint64_t seed_of(const WorldOptions& world, const std::string& name) {
  // The name's FNV-1a hash (Fowler, Noll, Vo), combined with the world's seed.
  uint64_t hash = 14695981039346656037u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash ^ (world.seed * 0x9e3779b97f4a7c15u);
}

}  // namespace

SimRobot::SimRobot(std::shared_ptr<const RobotModel> model, const RobotOptions& options,
                   const WorldOptions& world)
    : model_(std::move(model)),
      options_(options),
      tree_(*model_, options.mass_scale, options.errors.torso_com),
      // On a flat floor the corners of the outline carry what a grid of points would; bumps need
      // points inside the outline.
      collisions_(*model_, tree_, world.num_sole_points,
                  Floor(world.floor).is_flat() ? 0 : world.sole_point_spacing),
      integrator_(tree_, options.is_on_stand, world.gravity),
      drives_(*model_, tree_, options),
      targets_(model_->num_motors(), options.command_latency_ticks),
      accumulator_(*model_, tree_, world.gravity),
      sensors_(*model_, sensor_options(options), seed_of(world, options.name)),
      floor_(world.floor),
      // A stream of its own: losses must not change the sensors' noise.
      random_(~seed_of(world, options.name)),
      motor_position_(Eigen::VectorXd::Zero(model_->num_motors())),
      motor_velocity_(Eigen::VectorXd::Zero(model_->num_motors())),
      encoder_position_(Eigen::VectorXd::Zero(model_->num_motors())) {
  return_to_start();
  switch_on();
}

Eigen::Isometry3d SimRobot::link_pose(int link) const {
  // Links behind fixed joints are parts of one body of the tree.
  Eigen::Isometry3d pose = dynamics().pose(tree_.body_of_link(link)) * tree_.pose_in_body(link);
  const int joint = model_->links()[link].parent_joint;
  if (joint < 0) return pose;
  for (int motor = 0; motor < model_->num_motors(); ++motor) {
    // Motors that open a hand have no degree of freedom in the tree: their angle is added here.
    if (!drives_.is_opening(motor) || model_->motors()[motor] != joint) continue;
    const double opening = drives_.position(motor, state());
    pose = pose * Eigen::AngleAxisd(opening, model_->joints()[joint].axis);
  }
  return pose;
}

double SimRobot::energy() const {
  const double potential =
      // -m g . c, with gravity as a vector.
      tree_.total_mass() * -integrator_.gravity().dot(dynamics().center_of_mass());
  return dynamics().kinetic_energy() + potential + drives_.energy(state());
}

// Puts joints and targets at `position`, and the root so high that the lowest point touches the
// floor at ground_position.z.
void SimRobot::place_joints(const std::vector<double>& position, const Vector3d& ground_position,
                            const Quaterniond& orientation) {
  drives_.place(position);
  MotorTargets targets = targets_.newest();
  Eigen::VectorXd coordinate = Eigen::VectorXd::Zero(tree_.num_dofs());
  for (int i = 0; i < model_->num_motors(); ++i) {
    targets.position[i] = position[i];
    if (!drives_.is_opening(i)) coordinate[drives_.dof(i)] = position[i];
  }
  targets_.set_at_once(targets);
  // First with the root on the ground, to see how far the lowest point is from it.
  drag_time_ = 0;
  integrator_.place(coordinate, {ground_position.x(), ground_position.y(), 0}, orientation);
  integrator_.move_root({ground_position.x(), ground_position.y(),
                         ground_position.z() - lowest_point(collisions_, dynamics(), floor_)});
  update_motor_state();
  accumulator_.begin_tick(dynamics());
  // Sensor readings are means over a tick; none may contain motion from before the jump.
  sensors_.jump(true_motion());
}

void SimRobot::place(const Posture* posture, const Vector3d& ground_position,
                     const Quaterniond* orientation) {
  const std::vector<double> joints =
      posture != nullptr ? posture->position
                         : std::vector<double>(motor_position_.data(),
                                               motor_position_.data() + motor_position_.size());
  place_joints(joints, ground_position,
               orientation != nullptr ? *orientation
                                      : resting_orientation(*model_, tree_, collisions_, posture));
}

void SimRobot::return_to_start() {
  const std::string& name =
      options_.posture.empty() ? model_->references().ready : options_.posture;
  const Posture* posture = model_->find_posture(name);
  if (posture == nullptr) {
    throw ConfigError("robot " + model_->name() + " has no posture \"" + name + "\"");
  }
  const Quaterniond heading(Eigen::AngleAxisd(options_.heading, Vector3d::UnitZ()));
  place_joints(posture->position, {options_.position.x(), options_.position.y(), options_.height},
               heading * resting_orientation(*model_, tree_, collisions_, posture));
}

void SimRobot::switch_on() {
  MotorTargets targets = targets_.newest();
  targets.stiffness.setOnes();
  targets_.set_at_once(targets);
  drives_.switch_on();
  sensors_.reset(true_motion());
}

void SimRobot::push(int link, const Vector3d& impulse) {
  integrator_.add_impulse(tree_.body_of_link(link), impulse);
}

void SimRobot::drag(const LinkDrag& drag) {
  drag_ = drag;
  drag_time_ = kDragTime;
}

void SimRobot::apply_drag(double h) {
  if (drag_time_ <= 0) return;
  drag_time_ -= h;
  const int body = tree_.body_of_link(drag_.link);
  const Vector3d point = link_pose(drag_.link) * drag_.point;
  const Vector3d target = drag_.is_in_torso ? link_pose(0) * drag_.target : drag_.target;
  Vector3d force =
      kDragStiffness * (target - point) - kDragDamping * dynamics().velocity_at(body, point);
  const double size = force.norm();
  if (size > kMaxDragForce) force *= kMaxDragForce / size;
  integrator_.add_impulse_at(body, point, h * force);
}

void SimRobot::update_motor_state() {
  for (int i = 0; i < model_->num_motors(); ++i) {
    motor_position_[i] = drives_.position(i, state());
    motor_velocity_[i] = drives_.speed(i, state());
    encoder_position_[i] = drives_.encoder_position(i, state());
  }
}

const TrueMotion& SimRobot::true_motion() {
  return accumulator_.means(encoder_position_, drives_.torque(), state(), dynamics());
}

void SimRobot::begin_tick() {
  targets_.begin_tick();
  accumulator_.begin_tick(dynamics());
}

// Order: torques of the tick heat the motors before new targets take effect; sensors read the state
// last.
void SimRobot::end_tick(double period) {
  drives_.end_tick(accumulator_.torque_impulse(), targets_.current(), period);
  targets_.end_tick();
  update_motor_state();
  sensors_.update(true_motion(), period);
  draw_losses();
}

void SimRobot::draw_losses() {
  const RobotErrors& errors = options_.errors;
  if (errors.sensor_loss > 0) are_readings_lost_ = random_.uniform() < errors.sensor_loss;
  if (errors.command_loss > 0) are_targets_lost_ = random_.uniform() < errors.command_loss;
}

void SimRobot::begin_step(double h, Eigen::Ref<Eigen::VectorXd> scaled_velocity) {
  is_in_contact_ = false;
  integrator_.begin_step(h);
  drives_.begin_step(h, targets_.current(), integrator_);
  scaled_velocity = integrator_.factorize();
}

// Steps of the fast engine in the order of the calls: begin_step(), add_joint_rows(), solver,
// add_missed_bounds() and solver until nothing is missed, end_step().
void SimRobot::add_joint_rows(double h, ConstraintSolver& solver) {
  drives_.add_rows(h, state(), dynamics(), first_dof_, solver);
}

bool SimRobot::add_missed_bounds(double h, const Eigen::VectorXd& scaled_velocity,
                                 ConstraintSolver& solver) {
  const Eigen::VectorXd& velocity =
      integrator_.velocity_of(scaled_velocity.segment(first_dof_, tree_.num_dofs()));
  return drives_.add_missed_bounds(h, velocity, dynamics(), first_dof_, solver);
}

void SimRobot::add_foot_load(int foot, const Vector3d& point, const Vector3d& impulse) {
  accumulator_.add_foot_impulse(foot, point, impulse, dynamics());
}

// For engines that integrate by themselves (MuJoCo, Simbody): takes their state over.
void SimRobot::end_explicit_step(double h, const TreeState& state) {
  integrator_.set_state(state);
  drives_.end_explicit_step(h, state);
  accumulator_.add_step(h, state, dynamics(), drives_.torque());
}

void SimRobot::end_step(double h, const ConstraintSolver& solver) {
  // First the torques, from the impulses of the joints' rows; the accumulator needs them together
  // with the state that they led to.
  drives_.end_step(h, state().velocity, solver);
  integrator_.integrate(h, is_in_contact_);
  accumulator_.add_step(h, state(), dynamics(), drives_.torque());
}

}  // namespace nao::sim
