#include "sim/mujoco_engine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace nao::sim {
namespace {

using Eigen::Vector3d;

/** MuJoCo's default time constant of a contact, s, which goes with the default stiffness of
 * Materials. */
constexpr double kContactTime = 0.02;

/** MuJoCo's function for a plane and a sphere. */
mjfCollision collide_with_plane = nullptr;

/** Contact of a sphere with the floor, whose bumps are in the user data of the plane's geom. Our
 * surface in the place of MuJoCo's height fields: these are made for shapes that are not small
 * compared with a cell. */
// mjCOLLISIONFUNC's signature. Returns the number of contacts written: 0 or 1. MuJoCo completes the
// contact's frame from its first axis; the second is left 0 for that.
int collide_with_floor(const mjModel* model, const mjData* data, mjContact* contact, int plane,
                       int sphere, mjtNum margin) {
  const mjtNum* user = model->geom_user + static_cast<long>(model->nuser_geom) * plane;
  if (model->nuser_geom < 3 || !(user[0] > 0)) {
    return collide_with_plane(model, data, contact, plane, sphere, margin);
  }
  const Floor floor({user[0], user[1], static_cast<uint64_t>(user[2])});
  const mjtNum* center = data->geom_xpos + 3 * sphere;
  const mjtNum radius = model->geom_size[3 * sphere];
  const Floor::Plane tangent = floor.at(center[0], center[1]);
  // The same plane of the triangle as ContactDetector::to_floor(); pos is in the middle between
  // both surfaces, as MuJoCo defines it.
  const double distance = tangent.normal.z() * (center[2] - tangent.height) - radius;
  if (distance > margin) return 0;
  contact->dist = distance;
  for (int k = 0; k < 3; ++k) {
    contact->frame[k] = tangent.normal[k];
    contact->frame[3 + k] = 0;
    contact->pos[k] = center[k] - (radius + distance / 2) * tangent.normal[k];
  }
  return 1;
}

// The table is one for the process: replaced once, and the original kept for flat floors.
void use_our_floor() {
  mjfCollision& function = mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_SPHERE];
  if (function == collide_with_floor) return;
  collide_with_plane = std::exchange(function, collide_with_floor);
}

/** Decides which side of a contact is reported first: the ball, then robots. */
int rank(const Surface& surface) {
  if (surface.kind == Surface::Kind::kBall) return 0;
  return surface.kind == Surface::Kind::kRobot ? 1 : 2;
}

}  // namespace

MujocoEngine::MujocoEngine(const SceneFile& scene, const WorldOptions& options,
                           MovingBodies& bodies)
    : Engine(options, bodies), statics_(make_goal_shapes(scene)) {
  use_our_floor();
  build();
}

void MujocoEngine::add_robot() {
  build();
}

// The whole model is recompiled whenever a robot is added: MuJoCo's sizes are fixed.
void MujocoEngine::build() {
  MujocoScene scene;
  for (const auto& robot : bodies_.robots) scene.robots.push_back(robot.get());
  if (bodies_.ball) scene.ball = &bodies_.ball->description();
  scene.statics = statics_;
  // Points carry all floor contacts, as in the fast engine; servos and friction of joints come from
  // JointDrives instead, so that all engines have the same motors.
  MujocoModelOptions how;
  how.has_points_only = true;
  how.has_servos = false;
  how.has_friction = false;
  how.has_materials = true;
  model_ = load_mjcf(to_mjcf(scene, options_, how));
  // A mimic joint has the stops of the joint that it follows.
  for (int i = 0; i < model_->neq; ++i) model_->jnt_limited[model_->eq_obj1id[i]] = 0;
  data_.reset(mj_makeData(model_.get()));
  robots_.clear();
  states_.clear();
  for (int i = 0; i < bodies_.num_robots(); ++i) {
    robots_.emplace_back(*model_, *bodies_.robots[i], i);
    states_.push_back(bodies_.robots[i]->state());
  }
  if (bodies_.ball) {
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, "ball");
    ball_position_ = model_->jnt_qposadr[joint];
    ball_dof_ = model_->jnt_dofadr[joint];
  }
  identify_geoms();
  write_states();
}

// Which surface, foot and robot each geom belongs to, from names and user data that Writer wrote:
// unnamed geoms are a robot's. Also sets each geom's contact stiffness.
void MujocoEngine::identify_geoms() {
  std::vector<int> robot_of_body(model_->nbody, -1);
  for (int i = 0; i < bodies_.num_robots(); ++i) {
    for (int body = 0; body < bodies_.robots[i]->tree().num_bodies(); ++body) {
      robot_of_body[mj_name2id(model_.get(), mjOBJ_BODY, mujoco_body_name(i, body).c_str())] = i;
    }
  }
  // MuJoCo's stiffness goes with 1 / timeconst^2: a contact k times stiffer has a time constant
  // shorter by the square root of k.
  const double softness =
      std::sqrt(Materials().contact_stiffness / options_.materials.contact_stiffness);
  geoms_.assign(model_->ngeom, {});
  for (int i = 0; i < model_->ngeom; ++i) {
    const char* text = mj_id2name(model_.get(), mjOBJ_GEOM, i);
    const std::string name = text == nullptr ? "" : text;
    Geom& geom = geoms_[i];
    if (name.rfind("net", 0) == 0) geom.surface.kind = Surface::Kind::kNet;
    if (name.rfind("goal", 0) == 0) geom.surface.kind = Surface::Kind::kGoal;
    if (name == "ball") geom.surface.kind = Surface::Kind::kBall;
    if (!name.empty()) continue;
    const mjtNum* user = model_->geom_user + static_cast<long>(model_->nuser_geom) * i;
    geom.surface = {Surface::Kind::kRobot, robot_of_body[model_->geom_bodyid[i]],
                    static_cast<int>(user[0])};
    geom.foot = static_cast<int>(user[1]);
    // A time constant of less than two steps is no longer stable (MuJoCo's documentation, solref).
    model_->geom_solref[mjNREF * i] = std::max(2 * options_.step, kContactTime * softness);
  }
}

void MujocoEngine::reset() {
  num_steps_ = 0;
  write_states();
}

void MujocoEngine::write_states() {
  // mj_resetData() also clears the warm start; the state of all bodies is written again.
  contacts_.clear();
  mj_resetData(model_.get(), data_.get());
  for (int i = 0; i < bodies_.num_robots(); ++i) forget_contacts_of_robot(i);
  if (bodies_.ball) write_ball();
}

void MujocoEngine::forget_contacts_of_robot(int index) {
  const SimRobot& robot = *bodies_.robots[index];
  robots_[index].write(robot.tree(), robot.state(), *model_, *data_);
  // Accelerations of the old place would be the start value of the first solution.
  mju_zero(data_->qacc_warmstart, model_->nv);
}

void MujocoEngine::forget_contacts_of_ball() {
  write_ball();
  mju_zero(data_->qacc_warmstart, model_->nv);
}

void MujocoEngine::write_ball() {
  const BallState& ball = bodies_.ball->state();
  const Eigen::Quaterniond& q = ball.orientation;
  const double orientation[] = {q.w(), q.x(), q.y(), q.z()};
  // A free joint's angular velocity is in the body's own axes in MuJoCo, in W here.
  const Vector3d turning = q.conjugate() * ball.angular_velocity;
  for (int k = 0; k < 3; ++k) {
    data_->qpos[ball_position_ + k] = ball.position[k];
    data_->qvel[ball_dof_ + k] = ball.velocity[k];
    data_->qvel[ball_dof_ + 3 + k] = turning[k];
  }
  for (int k = 0; k < 4; ++k) data_->qpos[ball_position_ + 3 + k] = orientation[k];
}

void MujocoEngine::apply_forces(int index) {
  SimRobot& robot = *bodies_.robots[index];
  const MujocoRobot& in_mujoco = robots_[index];
  const double h = options_.step;
  // Pushes are impulses; as a force over one step they give the same change of momentum. The root's
  // moment is in the root's axes.
  const Eigen::VectorXd impulses = robot.take_impulses();
  if (const int root = in_mujoco.root_dof(); root >= 0) {
    const Vector3d moment = robot.state().orientation.conjugate() * Vector3d(impulses.head<3>());
    for (int k = 0; k < 3; ++k) {
      data_->qfrc_applied[root + k] = impulses[3 + k] / h;
      data_->qfrc_applied[root + 3 + k] = moment[k] / h;
    }
  }
  // Servo torques from the state at the start of the step. Damping and dry friction are left to
  // MuJoCo, which integrates the first implicitly and the second as a constraint.
  for (const JointForce& force : robot.begin_explicit_step(h)) {
    const int dof = in_mujoco.dof(force.dof);
    data_->qfrc_applied[dof] = force.torque + impulses[force.dof] / h;
    model_->dof_armature[dof] = force.inertia;
    model_->dof_damping[dof] = force.viscous_friction;
    model_->dof_frictionloss[dof] = force.dry_friction;
  }
}

// Rolling resistance is ours: MuJoCo's has a pyramidal cone, with which a ball that rolls forward
// has none sideways, and it lets a resting ball creep.
void MujocoEngine::apply_forces_on_ball() {
  Ball& ball = *bodies_.ball;
  const double h = options_.step;
  double load = 0;
  for (const Contact& contact : contacts_) {
    const bool is_on_floor =
        contact.a.kind == Surface::Kind::kBall && contact.b.kind == Surface::Kind::kFloor;
    if (is_on_floor) load += contact.force_on_a.z();
  }
  const double arm =
      ball.rolling_arm(options_.materials.ball_rolling_deceleration, options_.gravity.norm());
  const BallState& state = ball.state();
  const double rate = state.angular_velocity.norm();
  // At most as much as stops the rotation in this step: I w / h.
  const double stopping = ball.inertia() * rate / h;
  const double torque = std::min(arm * load, stopping);
  // A free joint's torque is in the body's own axes.
  Vector3d moment = Vector3d::Zero();
  if (torque > 0) {
    moment = state.orientation.conjugate() * Vector3d(-torque / rate * state.angular_velocity);
  }
  const Vector3d impulse = ball.take_impulse();
  for (int k = 0; k < 3; ++k) {
    data_->qfrc_applied[ball_dof_ + k] = impulse[k] / h;
    data_->qfrc_applied[ball_dof_ + 3 + k] = moment[k];
  }
}

void MujocoEngine::step() {
  for (const auto& robot : bodies_.robots) robot->apply_drag(options_.step);
  for (int i = 0; i < bodies_.num_robots(); ++i) apply_forces(i);
  if (bodies_.ball) apply_forces_on_ball();
  mj_step(model_.get(), data_.get());
  ++num_steps_;
  read_contacts();
  read_states();
}

void MujocoEngine::read_contacts() {
  contacts_.clear();
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& from = data_->contact[i];
    // Candidates that MuJoCo left out of the solution have no address.
    if (from.efc_address < 0) continue;
    mjtNum in_frame[6];
    mj_contactForce(model_.get(), data_.get(), i, in_frame);
    if (!(in_frame[0] > 0)) continue;
    // On the second geom, which the normal points to.
    Vector3d force = Vector3d::Zero();
    // frame's rows are the normal and two tangents in W: R^T f.
    for (int row = 0; row < 3; ++row) {
      for (int k = 0; k < 3; ++k) force[k] += in_frame[row] * from.frame[3 * row + k];
    }
    const Geom* a = &geoms_[from.geom2];
    const Geom* b = &geoms_[from.geom1];
    if (rank(b->surface) < rank(a->surface)) {
      std::swap(a, b);
      force = -force;
    }
    const Vector3d position(from.pos[0], from.pos[1], from.pos[2]);
    contacts_.push_back({a->surface, b->surface, position, force});
    // Foot sensors get the impulse of the step.
    if (a->foot >= 0) {
      bodies_.robots[a->surface.robot]->add_foot_load(a->foot, position, options_.step * force);
    }
  }
}

// MuJoCo counts these warnings when a state is not finite or too large, and resets itself.
bool MujocoEngine::has_failed() const {
  return data_->warning[mjWARN_BADQPOS].number + data_->warning[mjWARN_BADQVEL].number +
             data_->warning[mjWARN_BADQACC].number >
         0;
}

void MujocoEngine::read_states() {
  // MuJoCo resets itself after a step that is not finite. The engine then reports a state that is
  // not finite, and the world resets everything.
  const bool is_valid = !has_failed();
  const double lost = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < bodies_.num_robots(); ++i) {
    SimRobot& robot = *bodies_.robots[i];
    // Fields that MuJoCo does not have (a root on a stand) keep the robot's own values.
    TreeState& state = states_[i];
    state = robot.state();
    robots_[i].read(robot.tree(), *data_, state);
    if (!is_valid) state.position.setConstant(lost);
    robot.end_explicit_step(options_.step, state);
  }
  if (bodies_.ball) {
    const mjtNum* q = data_->qpos + ball_position_;
    const mjtNum* v = data_->qvel + ball_dof_;
    BallState ball;
    ball.position = {q[0], q[1], q[2]};
    ball.orientation = Eigen::Quaterniond(q[3], q[4], q[5], q[6]);
    ball.velocity = {v[0], v[1], v[2]};
    ball.angular_velocity = ball.orientation * Vector3d(v[3], v[4], v[5]);
    if (!is_valid) ball.position.setConstant(lost);
    bodies_.ball->set_state(ball);
  }
  // The counters are cleared, so that the next step is judged by itself.
  if (!is_valid) {
    for (const int kind : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
      data_->warning[kind].number = 0;
    }
  }
}

int64_t MujocoEngine::num_dropped_contacts() const {
  return data_->warning[mjWARN_CONTACTFULL].number + data_->warning[mjWARN_CNSTRFULL].number;
}

}  // namespace nao::sim
