// Compiled as C++17: Simbody's headers are not valid C++20.
#include "sim/simbody_engine.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "common/linear_solver.h"
#include "sim/contact_damping.h"
#include "sim/simbody_model.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

/** Longest step of the integrator, s. Measured: a standing robot with rotor inertia and explicit
 * contacts is stable at 0.5 ms. */
constexpr double kMaxStep = 0.0005;
/** Tolerance of the coupled joints, rad. Chosen: a tenth of an encoder's step. */
constexpr double kConstraintTolerance = 1e-4;
/** Surface speed of a ball below which its rolling resistance fades out, m/s: it is explicit, and
 * would change direction from step to step at rest. */
constexpr double kRollingSpeed = 0.01;
/** Contact candidates of the scene, and of each robot. Chosen as for the fast engine. */
constexpr int kMaxCandidates = 96;

/** A force element that asks its owner. */
template <class Owner>
class OwnersForce : public SimTK::Force::Custom::Implementation {
 public:
  explicit OwnersForce(Owner& owner) : owner_(owner) {}
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& /*particle_forces*/,
                 SimTK::Vector& mobility_forces) const override {
    owner_.calc_forces(state, body_forces, mobility_forces);
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State& /*state*/) const override { return 0; }

 private:
  Owner& owner_;
};

void integrate(const SimTK::MultibodySystem& system, SimTK::Integrator& integrator,
               double duration) {
  // Motor torques have changed since the last step's end although the state has not: Simbody's
  // cached forces are invalid.
  // The step begins with the accelerations of its first state, under the new forces.
  SimTK::State& start = integrator.updAdvancedState();
  start.invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
  system.realize(start, SimTK::Stage::Acceleration);
  const double end = integrator.getTime() + duration;
  // The first call after a start returns at once.
  while (integrator.getTime() < end - 1e-9) integrator.stepTo(end, end);
}

/** Substeps of at most kMaxStep into which a step is divided evenly. */
int num_substeps(double step) {
  return static_cast<int>(std::ceil(step / kMaxStep - 1e-9));
}

std::unique_ptr<SimTK::Integrator> make_integrator(const SimTK::MultibodySystem& system,
                                                   double step) {
  auto integrator =
      std::make_unique<SimTK::SemiExplicitEulerIntegrator>(system, step / num_substeps(step));
  integrator->setConstraintTolerance(kConstraintTolerance);
  // stepTo() then ends with a state of the integrator itself, from which the next step continues.
  integrator->setAllowInterpolation(false);
  return integrator;
}

}  // namespace

/** One robot as a Simbody system. */
class SimbodyEngine::RobotSystem {
 public:
  RobotSystem(SimbodyEngine& engine, int index)
      : engine_(engine),
        index_(index),
        robot_(*engine.bodies_.robots[index]),
        model_(robot_.model(), robot_.options().mass_scale, robot_.options().errors.torso_com),
        forces_(model_.system()),
        damping_(robot_.tree(), robot_.dynamics()),
        state_(robot_.state()),
        impulses_(Eigen::VectorXd::Zero(robot_.tree().num_dofs())) {
    // The force belongs to forces_.
    // NOLINTNEXTLINE(bugprone-unused-raii)
    SimTK::Force::Custom(forces_, new OwnersForce<RobotSystem>(*this));
    model_.system().realizeTopology();
    for (int body = 0; body < robot_.tree().num_bodies(); ++body) {
      // First generalized speed of each body in Simbody's vector, which is not our order of dofs.
      first_u_.push_back(model_.mobilized(body).getFirstUIndex(model_.default_state()));
    }
    dof_of_u_.resize(model_.matter().getNumMobilities());
    for (int i = 0; i < 6; ++i) dof_of_u_[first_u_[0] + i] = {i, 1};
    for (int body = 1; body < robot_.tree().num_bodies(); ++body) {
      dof_of_u_[first_u_[body]] = {robot_.tree().bodies()[body].dof,
                                   robot_.tree().bodies()[body].ratio};
    }
    start();
  }

  /** Takes over the robot's state. */
  // This is also called after a jump: the integrator begins with the new state, without forces of
  // the old one.
  void start() {
    SimTK::State state = model_.default_state();
    model_.set_state(robot_.tree(), robot_.state(), state);
    // On a stand, the free joint of the root is locked.
    if (robot_.options().is_on_stand) model_.mobilized(0).lock(state);
    state_ = robot_.state();
    motors_.clear();
    impulses_.setZero();
    integrator_ = make_integrator(model_.system(), engine_.options_.step);
    step_start_ = 0;
    integrator_->initialize(state);
  }

  void step(double h) {
    step_start_ = integrator_->getTime();
    motors_ = robot_.begin_explicit_step(h);
    impulses_ = robot_.take_impulses();
    try {
      integrate(model_.system(), *integrator_, h);
      read(integrator_->getState());
    } catch (const std::exception&) {
      // Simbody rejects a state that is not finite. The engine then reports such a state, and the
      // world resets the robot.
      state_.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    robot_.set_state(state_);
  }
  /** Ends the step after contacts were collected. */
  void end_step(double h) { robot_.end_explicit_step(h, state_); }

  // Called by Simbody for every state of the integrator, also within a step. Poses and velocities
  // go through our own kinematics, so that contacts are found by the same code as in the fast
  // engine.
  void calc_forces(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                   SimTK::Vector& mobility_forces) {
    // The forces on the state at the step's end depend on the next targets: integrate() asks again.
    if (state.getTime() > step_start_ + engine_.options_.step - kMaxStep / 2) return;
    read(state);
    robot_.set_state(state_);
    add_weight(body_forces);
    add_contacts(engine_.substep_at(state.getTime() - step_start_), body_forces);
    add_motors(mobility_forces);
    add_implicit_forces(state, body_forces, mobility_forces);
  }

 private:
  // Dofs 0..5 are the root's, in the same order (angular, linear) in both.
  int u_of_dof(int dof) const {
    return dof < 6 ? first_u_[0] + dof : first_u_[robot_.tree().body_of_dof(dof)];
  }

  void read(const SimTK::State& state) {
    const SimTK::Vector q = model_.mobilized(0).getQAsVector(state);
    const SimTK::Vector u = model_.mobilized(0).getUAsVector(state);
    if (!robot_.options().is_on_stand) {
      state_.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
      state_.position = {q[4], q[5], q[6]};
      for (int i = 0; i < 6; ++i) state_.velocity[i] = u[i];
    }
    for (int dof = 6; dof < robot_.tree().num_dofs(); ++dof) {
      const int body = robot_.tree().body_of_dof(dof);
      state_.coordinate[dof] = model_.mobilized(body).getOneQ(state, 0);
      state_.velocity[dof] = model_.mobilized(body).getOneU(state, 0);
    }
  }

  // A force at a point as a spatial force at the body's origin: moment r x f, and f.
  void add_force(int body, const Vector3d& point, const Vector3d& force,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces) const {
    const Vector3d moment = (point - robot_.dynamics().position(body)).cross(force);
    body_forces[model_.bodies()[body].mobilized] +=
        SimTK::SpatialVec(to_simbody(moment), to_simbody(force));
  }

  // Gravity is applied here instead of by Simbody's Force::Gravity, so that it is among the forces
  // that add_implicit_forces() takes into account.
  void add_weight(SimTK::Vector_<SimTK::SpatialVec>& body_forces) const {
    for (int body = 0; body < robot_.tree().num_bodies(); ++body) {
      add_force(body, robot_.dynamics().body_center_of_mass(body),
                robot_.tree().bodies()[body].mass * engine_.options_.gravity, body_forces);
    }
  }

  void add_contacts(int64_t substep, SimTK::Vector_<SimTK::SpatialVec>& body_forces) {
    damping_.clear();
    // Contacts of all bodies are found, and those of this robot applied.
    for (const ContactCandidate& contact : engine_.find_candidates()) {
      const bool is_a = contact.a.kind == Surface::Kind::kRobot && contact.a.robot == index_;
      const bool is_b = contact.b.kind == Surface::Kind::kRobot && contact.b.robot == index_;
      if (!is_a && !is_b) continue;
      const CompliantForce force = engine_.law_.force(contact, substep);
      const Vector3d& point = contact.proximity.point;
      if (is_a) add_force(contact.body_a, point, force.on_a, body_forces);
      if (is_b) add_force(contact.body_b, point, -force.on_a, body_forces);
      if (force.damping.isZero(0)) continue;
      damping_.add(is_a ? contact.body_a : -1, is_b ? contact.body_b : -1, point, force.damping);
    }
  }

  // Pushes as forces over the step, then servo torque, viscous and dry friction, and stops.
  void add_motors(SimTK::Vector& mobility_forces) const {
    const double h = engine_.options_.step;
    for (int dof = 0; dof < robot_.tree().num_dofs(); ++dof) {
      mobility_forces[u_of_dof(dof)] += impulses_[dof] / h;
    }
    for (const JointForce& motor : motors_) {
      const double speed = state_.velocity[motor.dof];
      // Dry friction is smoothed below the speed that it would stop within a step.
      const double blur = std::max(0.01, kMaxStep * motor.dry_friction / motor_inertia(motor));
      mobility_forces[u_of_dof(motor.dof)] += motor.torque - motor.viscous_friction * speed -
                                              motor.dry_friction * std::tanh(speed / blur) +
                                              stop_torque(motor);
    }
  }

  static double motor_inertia(const JointForce& motor) { return std::max(motor.inertia, 1e-5); }

  double stop_torque(const JointForce& motor) const {
    const Joint& joint =
        robot_.model().joints()[robot_.tree().bodies()[robot_.tree().body_of_dof(motor.dof)].joint];
    const double angle = state_.coordinate[motor.dof];
    // Angle beyond the range, rad, with its sign.
    const double bent = std::max(0.0, angle - joint.upper) + std::min(0.0, angle - joint.lower);
    if (bent == 0) return 0;
    // The stop is as stiff and as damped as an explicit step allows.
    const double inertia = motor_inertia(motor);
    const double stiffness = std::min(kStopStiffness, 0.2 * inertia / (kMaxStep * kMaxStep));
    const double damping = std::min(kStopDamping, 0.3 * inertia / kMaxStep);
    return -stiffness * bent - damping * state_.velocity[motor.dof];
  }

  /** Adds to all other forces f what depends on the acceleration u': the torques of the rotors'
   * inertia J, -J u', and the change of the contacts' damping within the substep, with
   * (M + J + h sum(J_c^T D J_c)) u' = f, in the degrees of freedom of the tree, where coupled
   * joints are one. */
  // Simbody has neither armature nor implicit forces. Moving them to the right side needs u' first:
  // solved with our own mass matrix, which is Simbody's to 1e-11 and takes a hundredth of the time.
  void add_implicit_forces(const SimTK::State& state,
                           SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                           SimTK::Vector& mobility_forces) {
    const SimTK::SimbodyMatterSubsystem& matter = model_.matter();
    const int num_u = matter.getNumMobilities();
    SimTK::Vector residual;
    const SimTK::Vector no_acceleration(num_u, 0.0);
    // Residual force at zero acceleration: C(q, u) - f, so that f - C is its negative.
    matter.calcResidualForceIgnoringConstraints(state, mobility_forces, body_forces,
                                                no_acceleration, residual);
    const Tree& tree = robot_.tree();
    const int first = robot_.options().is_on_stand ? 6 : 0;
    // Coupled joints: Simbody's velocities are u = T v, therefore T^T M T v' = T^T (f - C). A row
    // of T has one entry: the dof of the joint, with its ratio. Our M is T^T M T.
    reduced_force_.setZero(tree.num_dofs());
    for (int k = 0; k < num_u; ++k) {
      const DofOfU& column = dof_of_u_[k];
      reduced_force_[column.dof] -= column.ratio * residual[k];
    }
    robot_.dynamics().copy_mass_matrix(reduced_mass_);
    for (const JointForce& motor : motors_) reduced_mass_(motor.dof, motor.dof) += motor.inertia;
    const double h = engine_.options_.step / num_substeps(engine_.options_.step);
    damping_.add_to_mass(h, reduced_mass_);
    // On a stand the root's six are not solved for.
    const long count = tree.num_dofs() - first;
    solve_positive_definite(reduced_mass_.bottomRightCorner(count, count),
                            reduced_force_.tail(count));
    reduced_force_.head(first).setZero();
    const Eigen::VectorXd& acceleration = reduced_force_;
    for (const JointForce& motor : motors_) {
      // The reaction of each rotor, in place of an armature in M.
      mobility_forces[u_of_dof(motor.dof)] -= motor.inertia * acceleration[motor.dof];
    }
    for (const ContactDamping::Contact& contact : damping_.contacts()) {
      const Vector3d force = ContactDamping::force_on_a(contact, h, acceleration);
      if (contact.body_a >= 0) add_force(contact.body_a, contact.point, force, body_forces);
      if (contact.body_b >= 0) add_force(contact.body_b, contact.point, -force, body_forces);
    }
  }

  SimbodyEngine& engine_;
  int index_;
  SimRobot& robot_;
  SimbodyModel model_;
  SimTK::GeneralForceSubsystem forces_;
  std::unique_ptr<SimTK::Integrator> integrator_;
  /** The integrator's time at the start of the step, s. */
  double step_start_ = 0;
  std::vector<int> first_u_;
  /** Our dof for each of Simbody's generalized speeds, which is `ratio` times the dof's speed. */
  struct DofOfU {
    int dof = 0;
    double ratio = 1;
  };
  std::vector<DofOfU> dof_of_u_;
  ContactDamping damping_;
  Eigen::MatrixXd reduced_mass_;
  Eigen::VectorXd reduced_force_;
  /** As computed last. */
  TreeState state_;
  std::vector<JointForce> motors_;
  Eigen::VectorXd impulses_;
};

/** The ball as a Simbody system. */
class SimbodyEngine::BallSystem {
 public:
  explicit BallSystem(SimbodyEngine& engine)
      : engine_(engine), ball_(*engine.bodies_.ball), matter_(system_), forces_(system_) {
    const BallDescription& ball = ball_.description();
    const SimTK::Body::Rigid body(
        {ball.mass, SimTK::Vec3(0), ball.mass * SimTK::UnitInertia::sphere(ball.radius)});
    body_ =
        SimTK::MobilizedBody::Free(matter_.Ground(), SimTK::Transform(), body, SimTK::Transform());
    // NOLINTNEXTLINE(bugprone-unused-raii)
    SimTK::Force::Custom(forces_, new OwnersForce<BallSystem>(*this));
    system_.realizeTopology();
    start();
  }

  void start() {
    SimTK::State state = system_.getDefaultState();
    const BallState& from = ball_.state();
    const Eigen::Quaterniond& r = from.orientation;
    const double q[] = {
        r.w(), r.x(), r.y(), r.z(), from.position.x(), from.position.y(), from.position.z()};
    for (int i = 0; i < 7; ++i) body_.setOneQ(state, i, q[i]);
    // Free's speeds: angular in W, then linear in W.
    for (int i = 0; i < 3; ++i) {
      body_.setOneU(state, i, from.angular_velocity[i]);
      body_.setOneU(state, 3 + i, from.velocity[i]);
    }
    impulse_.setZero();
    integrator_ = make_integrator(system_, engine_.options_.step);
    step_start_ = 0;
    integrator_->initialize(state);
  }

  void step(double h) {
    step_start_ = integrator_->getTime();
    impulse_ = ball_.take_impulse();
    integrate(system_, *integrator_, h);
    read(integrator_->getState());
  }

  void calc_forces(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                   SimTK::Vector& /*mobility_forces*/) {
    read(state);
    const BallState& now = ball_.state();
    Vector3d force =
        ball_.description().mass * engine_.options_.gravity + impulse_ / engine_.options_.step;
    Vector3d moment = Vector3d::Zero();
    const int64_t substep = engine_.substep_at(state.getTime() - step_start_);
    for (const ContactCandidate& contact : engine_.find_candidates()) {
      if (contact.a.kind != Surface::Kind::kBall) continue;
      const Vector3d pressing = engine_.law_.force(contact, substep).on_a;
      force += pressing;
      moment += (contact.proximity.point - now.position).cross(pressing);
      if (contact.b.kind != Surface::Kind::kFloor) continue;
      // As Ball::add_rolling_resistance(); the direction is smoothed near rest, as that of sliding
      // is. Rolling resistance: a torque of 7/5 r a / g N slows a solid sphere down by a.
      const double arm = 1.4 * ball_.radius() *
                         engine_.options_.materials.ball_rolling_deceleration /
                         engine_.options_.gravity.norm();
      const double rate = std::hypot(now.angular_velocity.norm(), kRollingSpeed / ball_.radius());
      moment -= arm * contact.proximity.normal.dot(pressing) / rate * now.angular_velocity;
    }
    body_forces[body_.getMobilizedBodyIndex()] +=
        SimTK::SpatialVec(to_simbody(moment), to_simbody(force));
  }

 private:
  void read(const SimTK::State& state) {
    BallState ball;
    const SimTK::Vector q = body_.getQAsVector(state);
    const SimTK::Vector u = body_.getUAsVector(state);
    ball.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    ball.position = {q[4], q[5], q[6]};
    ball.angular_velocity = {u[0], u[1], u[2]};
    ball.velocity = {u[3], u[4], u[5]};
    ball_.set_state(ball);
  }

  SimbodyEngine& engine_;
  Ball& ball_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::MobilizedBody body_;
  std::unique_ptr<SimTK::Integrator> integrator_;
  /** The integrator's time at the start of the step, s. */
  double step_start_ = 0;
  Vector3d impulse_ = Vector3d::Zero();
};

SimbodyEngine::SimbodyEngine(const SceneFile& scene, const WorldOptions& options,
                             MovingBodies& bodies)
    : options_(options),
      bodies_(bodies),
      detector_(scene, bodies, Floor(options.floor), options.step),
      law_(bodies, options, options.step / num_substeps(options.step)) {
  whole_.has_ball = bodies_.ball.has_value();
  candidates_.reserve(kMaxCandidates);
  if (bodies_.ball) ball_ = std::make_unique<BallSystem>(*this);
}

SimbodyEngine::~SimbodyEngine() = default;

void SimbodyEngine::add_robot() {
  detector_.add_robot();
  whole_.robots.push_back(bodies_.num_robots() - 1);
  candidates_.reserve(kMaxCandidates * (1 + bodies_.num_robots()));
  robots_.push_back(std::make_unique<RobotSystem>(*this, bodies_.num_robots() - 1));
}

void SimbodyEngine::reset() {
  num_steps_ = 0;
  detector_.clear();
  candidates_.reset_count();
  contacts_.clear();
  for (const auto& robot : robots_) robot->start();
  if (ball_ != nullptr) ball_->start();
}

void SimbodyEngine::forget_contacts_of_robot(int robot) {
  // A robot that is being added has no system yet.
  if (robot >= static_cast<int>(robots_.size())) return;
  detector_.forget_robot(robot);
  robots_[robot]->start();
}

void SimbodyEngine::forget_contacts_of_ball() {
  detector_.forget_ball();
  if (ball_ != nullptr) ball_->start();
}

// Robots and ball are systems of their own, stepped one after the other: each sees the others in
// their latest state. Contacts are collected when all have moved, from final states.
void SimbodyEngine::step() {
  for (const auto& robot : robots_) robot->step(options_.step);
  if (ball_ != nullptr) ball_->step(options_.step);
  ++num_steps_;
  collect_contacts();
  for (const auto& robot : robots_) robot->end_step(options_.step);
}

const std::vector<ContactCandidate>& SimbodyEngine::find_candidates() {
  detector_.begin_step(num_steps_);
  candidates_.clear();
  detector_.find(whole_, candidates_);
  return candidates_.list();
}

int64_t SimbodyEngine::substep_at(double time) const {
  const int count = num_substeps(options_.step);
  return num_steps_ * count + std::lround(time / options_.step * count);
}

void SimbodyEngine::collect_contacts() {
  contacts_.clear();
  for (const ContactCandidate& contact : find_candidates()) {
    const Vector3d force = law_.force(contact, substep_at(0)).on_a;
    if (force.isZero(0)) continue;
    const Vector3d& point = contact.proximity.point;
    contacts_.push_back({contact.a, contact.b, point, force});
    if (contact.foot >= 0) {
      bodies_.robots[contact.a.robot]->add_foot_load(contact.foot, point, options_.step * force);
    }
  }
}

}  // namespace nao::sim
