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

/** Longest substep, s. Measured with three substeps in a step of 2 ms: the joint angles of a walk
 * are off by 0.21 mrad from those at 0.05 ms (with four by 0.20), and robots under real.yaml walk
 * and get up as often. */
constexpr double kMaxStep = 0.0007;
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

/** Substeps of at most kMaxStep into which a step is divided evenly. */
int num_substeps(double step) {
  return static_cast<int>(std::ceil(step / kMaxStep - 1e-9));
}

/** Semi-explicit Euler, a substep of h seconds: the accelerations give the velocities, and these
 * the positions; then coupled joints are projected onto their constraints. What Simbody's
 * SemiExplicitEulerIntegrator does, which realizes the state's position twice and its acceleration
 * at the step's end too, where the next forces are not known yet. */
void integrate(const SimTK::MultibodySystem& system, const SimTK::SimbodyMatterSubsystem& matter,
               double h, SimTK::State& state) {
  system.realize(state, SimTK::Stage::Acceleration);
  // Of the poses at the substep's start.
  SimTK::Vector q_dot;
  state.updU() += h * state.getUDot();
  matter.multiplyByN(state, false, state.getU(), q_dot);
  state.updQ() += h * q_dot;
  system.project(state, kConstraintTolerance);
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
      // First generalized speed and coordinate of each body in Simbody's vectors, which are not in
      // our order of dofs.
      first_u_.push_back(model_.mobilized(body).getFirstUIndex(model_.default_state()));
      first_q_.push_back(model_.mobilized(body).getFirstQIndex(model_.default_state()));
    }
    wrenches_.resize(robot_.tree().num_bodies());
    start();
  }

  /** Takes over the robot's state. */
  // This is also called after a jump.
  void start() {
    simbody_state_ = model_.default_state();
    model_.set_state(robot_.tree(), robot_.state(), simbody_state_);
    // On a stand, the free joint of the root is locked.
    if (robot_.options().is_on_stand) model_.mobilized(0).lock(simbody_state_);
    state_ = robot_.state();
    motors_.clear();
    impulses_.setZero();
  }

  void step(double h) {
    motors_ = robot_.begin_explicit_step(h);
    impulses_ = robot_.take_impulses();
    // Servo torques have changed although the state has not: forces in Simbody's cache are invalid.
    simbody_state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
    const int count = num_substeps(h);
    try {
      for (substep_ = 0; substep_ < count; ++substep_) {
        integrate(model_.system(), model_.matter(), h / count, simbody_state_);
      }
      read(simbody_state_);
    } catch (const std::exception&) {
      // Simbody rejects a state that is not finite. The engine then reports such a state, and the
      // world resets the robot.
      state_.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    robot_.set_state(state_);
  }
  /** Ends the step after contacts were collected. */
  void end_step(double h) { robot_.end_explicit_step(h, state_); }

  // Called by Simbody at the start of every substep. Poses and velocities go through our own
  // kinematics, so that contacts are found by the same code as in the fast engine.
  void calc_forces(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                   SimTK::Vector& mobility_forces) {
    read(state);
    robot_.set_state(state_);
    std::fill(wrenches_.begin(), wrenches_.end(), SpatialVector());
    add_contacts();
    add_motors();
    add_implicit_forces();
    for (int body = 0; body < robot_.tree().num_bodies(); ++body) {
      const double mass = robot_.tree().bodies()[body].mass;
      add_force(body, robot_.dynamics().body_center_of_mass(body), mass * engine_.options_.gravity);
      // Moved from O to the body's origin.
      const SpatialVector& force = wrenches_[body];
      const Vector3d arm = robot_.dynamics().position(body) - robot_.dynamics().origin();
      body_forces[model_.bodies()[body].mobilized] += SimTK::SpatialVec(
          to_simbody(force.angular - arm.cross(force.linear)), to_simbody(force.linear));
    }
    for (int dof = 0; dof < robot_.tree().num_dofs(); ++dof) {
      mobility_forces[u_of_dof(dof)] += torques_[dof];
    }
  }

 private:
  // Dofs 0..5 are the root's, in the same order (angular, linear) in both.
  int u_of_dof(int dof) const {
    return dof < 6 ? first_u_[0] + dof : first_u_[robot_.tree().body_of_dof(dof)];
  }

  void read(const SimTK::State& state) {
    const SimTK::Vector& q = state.getQ();
    const SimTK::Vector& u = state.getU();
    if (!robot_.options().is_on_stand) {
      const int first = first_q_[0];
      state_.orientation =
          Eigen::Quaterniond(q[first], q[first + 1], q[first + 2], q[first + 3]).normalized();
      state_.position = {q[first + 4], q[first + 5], q[first + 6]};
      for (int i = 0; i < 6; ++i) state_.velocity[i] = u[first_u_[0] + i];
    }
    for (int dof = 6; dof < robot_.tree().num_dofs(); ++dof) {
      const int body = robot_.tree().body_of_dof(dof);
      state_.coordinate[dof] = q[first_q_[body]];
      state_.velocity[dof] = u[first_u_[body]];
    }
  }

  void add_force(int body, const Vector3d& point, const Vector3d& force) {
    add_wrench(body, {(point - robot_.dynamics().origin()).cross(force), force});
  }
  void add_wrench(int body, const SpatialVector& force) {
    wrenches_[body].angular += force.angular;
    wrenches_[body].linear += force.linear;
  }

  void add_contacts() {
    damping_.clear();
    // Contacts of all bodies are found, and those of this robot applied.
    for (const ContactCandidate& contact : engine_.find_candidates()) {
      const bool is_a = contact.a.kind == Surface::Kind::kRobot && contact.a.robot == index_;
      const bool is_b = contact.b.kind == Surface::Kind::kRobot && contact.b.robot == index_;
      if (!is_a && !is_b) continue;
      const CompliantForce force = engine_.law_.force(contact, engine_.number_of(substep_));
      const Vector3d& point = contact.proximity.point;
      if (is_a) add_force(contact.body_a, point, force.on_a);
      if (is_b) add_force(contact.body_b, point, -force.on_a);
      if (force.damping.isZero(0)) continue;
      damping_.add(is_a ? contact.body_a : -1, is_b ? contact.body_b : -1, point, force.damping);
    }
  }

  // Pushes as forces over the step, then servo torque, viscous and dry friction, and stops.
  void add_motors() {
    torques_ = impulses_ / engine_.options_.step;
    for (const JointForce& motor : motors_) {
      const double speed = state_.velocity[motor.dof];
      // Dry friction is smoothed below the speed that it would stop within a step.
      const double blur = std::max(0.01, kMaxStep * motor.dry_friction / motor_inertia(motor));
      torques_[motor.dof] += motor.torque - motor.viscous_friction * speed -
                             motor.dry_friction * std::tanh(speed / blur) + stop_torque(motor);
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
  // solved with our own mass matrix and bias forces, which are Simbody's to 1e-11 and take a
  // hundredth of the time.
  void add_implicit_forces() {
    const Tree& tree = robot_.tree();
    const TreeDynamics& dynamics = robot_.dynamics();
    // The bodies' forces pass through the joints towards the root.
    acceleration_ = torques_ - robot_.calc_bias();
    carried_ = wrenches_;
    for (int body = tree.num_bodies() - 1; body > 0; --body) {
      const SpatialVector& force = carried_[body];
      const SpatialVector motion = dynamics.motion(body);
      acceleration_[tree.bodies()[body].dof] +=
          motion.angular.dot(force.angular) + motion.linear.dot(force.linear);
      SpatialVector& above = carried_[tree.bodies()[body].parent];
      above.angular += force.angular;
      above.linear += force.linear;
    }
    acceleration_.head<3>() += carried_[0].angular;
    acceleration_.segment<3>(3) += carried_[0].linear;
    dynamics.copy_mass_matrix(mass_);
    for (const JointForce& motor : motors_) mass_(motor.dof, motor.dof) += motor.inertia;
    const double h = engine_.options_.step / num_substeps(engine_.options_.step);
    damping_.add_to_mass(h, mass_);
    // On a stand the root's six are not solved for.
    const int first = robot_.options().is_on_stand ? 6 : 0;
    const long count = tree.num_dofs() - first;
    solve_positive_definite(mass_.bottomRightCorner(count, count), acceleration_.tail(count));
    acceleration_.head(first).setZero();
    for (const JointForce& motor : motors_) {
      // The reaction of each rotor, in place of an armature in M.
      torques_[motor.dof] -= motor.inertia * acceleration_[motor.dof];
    }
    damping_.for_each_force(h, acceleration_, [this](int body, const SpatialVector& force) {
      add_wrench(body, force);
    });
  }

  SimbodyEngine& engine_;
  int index_;
  SimRobot& robot_;
  SimbodyModel model_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::State simbody_state_;
  /** Number of the substep within the step. */
  int substep_ = 0;
  std::vector<int> first_u_;
  std::vector<int> first_q_;
  ContactDamping damping_;
  /** As computed last. */
  TreeState state_;
  std::vector<JointForce> motors_;
  Eigen::VectorXd impulses_;
  /** Forces on the joints, (num_dofs), and on the bodies, about O. */
  Eigen::VectorXd torques_;
  std::vector<SpatialVector> wrenches_;
  // Workspace of add_implicit_forces().
  std::vector<SpatialVector> carried_;
  Eigen::MatrixXd mass_;
  Eigen::VectorXd acceleration_;
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
    state_ = system_.getDefaultState();
    const BallState& from = ball_.state();
    const Eigen::Quaterniond& r = from.orientation;
    const double q[] = {
        r.w(), r.x(), r.y(), r.z(), from.position.x(), from.position.y(), from.position.z()};
    for (int i = 0; i < 7; ++i) body_.setOneQ(state_, i, q[i]);
    // Free's speeds: angular in W, then linear in W.
    for (int i = 0; i < 3; ++i) {
      body_.setOneU(state_, i, from.angular_velocity[i]);
      body_.setOneU(state_, 3 + i, from.velocity[i]);
    }
    impulse_.setZero();
  }

  void step(double h) {
    impulse_ = ball_.take_impulse();
    // What presses on it, and a push, may have changed although the ball's state has not.
    state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
    const int count = num_substeps(h);
    for (substep_ = 0; substep_ < count; ++substep_) {
      integrate(system_, matter_, h / count, state_);
    }
    read(state_);
  }

  void calc_forces(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                   SimTK::Vector& /*mobility_forces*/) {
    read(state);
    const BallState& now = ball_.state();
    Vector3d force =
        ball_.description().mass * engine_.options_.gravity + impulse_ / engine_.options_.step;
    Vector3d moment = Vector3d::Zero();
    for (const ContactCandidate& contact : engine_.find_candidates()) {
      if (contact.a.kind != Surface::Kind::kBall) continue;
      const Vector3d pressing = engine_.law_.force(contact, engine_.number_of(substep_)).on_a;
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
  SimTK::State state_;
  /** Number of the substep within the step. */
  int substep_ = 0;
  Vector3d impulse_ = Vector3d::Zero();
};

SimbodyEngine::SimbodyEngine(const SceneFile& scene, const WorldOptions& options,
                             MovingBodies& bodies)
    : Engine(options, bodies),
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
  for (const auto& robot : bodies_.robots) robot->apply_drag(options_.step);
  for (const auto& robot : robots_) robot->step(options_.step);
  if (ball_ != nullptr) ball_->step(options_.step);
  ++num_steps_;
  collect_contacts();
  for (const auto& robot : robots_) robot->end_step(options_.step);
}

const std::vector<ContactCandidate>& SimbodyEngine::find_candidates() {
  candidates_.begin_step(num_steps_);
  detector_.find(whole_, candidates_);
  return candidates_.list();
}

int64_t SimbodyEngine::number_of(int substep) const {
  return num_steps_ * num_substeps(options_.step) + substep;
}

void SimbodyEngine::collect_contacts() {
  contacts_.clear();
  for (const ContactCandidate& contact : find_candidates()) {
    const Vector3d force = law_.force(contact, number_of(0)).on_a;
    if (force.isZero(0)) continue;
    const Vector3d& point = contact.proximity.point;
    contacts_.push_back({contact.a, contact.b, point, force});
    if (contact.foot >= 0) {
      bodies_.robots[contact.a.robot]->add_foot_load(contact.foot, point, options_.step * force);
    }
  }
}

}  // namespace nao::sim
