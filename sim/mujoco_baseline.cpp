#include "sim/mujoco_baseline.h"

#include <algorithm>

namespace nao::sim {

MujocoBaseline::MujocoBaseline(const SimRobot& robot, const WorldOptions& world,
                               const BaselineOptions& options)
    : has_matched_laws_(options.laws == BaselineLaws::kMatched) {
  MujocoScene scene;
  scene.robots = {&robot};
  MujocoModelOptions how;
  how.has_sole_points = options.feet == BaselineFeet::kPoints;
  how.has_points_only = how.has_sole_points && has_matched_laws_;
  how.has_servos = !options.is_limp;
  model_ = load_mjcf(to_mjcf(scene, world, how));
  if (has_matched_laws_) match_laws(world);
  data_.reset(mj_makeData(model_.get()));
  robot_.emplace(*model_, robot, 0);

  const Tree& tree = robot.tree();
  // Actuators are written in the order of the bodies (Writer::write_servos()), and are numbered in
  // the same order here; openings of hands have none.
  actuator_of_motor_.assign(robot.model().num_motors(), -1);
  int actuator = 0;
  for (int i = 1; i < tree.num_bodies(); ++i) {
    const int motor = motor_of_body(robot, i);
    if (motor < 0 || options.is_limp) continue;
    actuator_of_motor_[motor] = actuator++;
    const Motor& drive = robot.model().motor(motor);
    // Back-EMF as a damper: the slope of the torque-speed line, N m s/rad.
    back_emf_.push_back(drive.peak_torque / drive.no_load_velocity);
  }
  set_state(tree, robot.state());
  set_targets(robot.motor_position());
}

void MujocoBaseline::match_laws(const WorldOptions& world) {
  // MuJoCo's contact force f and acceleration a obey a + R f = -b v - k r with R = (1 - d) / d * A,
  // A the body's mean inverse inertia, d the impedance, and k, b those of solref over d (direct
  // format; MuJoCo's documentation, Computation, Solver parameters). For a small d the term a means
  // a mass of d (almost 0) next to a spring k / R and a damper b / R.
  constexpr double kImpedance = 0.02;
  constexpr double kRigid = 0.9999;
  // Ratio of the damper along the surface of a sticking contact to the normal one.
  model_->opt.impratio = 10;
  model_->opt.cone = mjCONE_ELLIPTIC;
  // solimp = (d_min, d_max, width, ...): equal first two make the impedance constant. Negative
  // solref is MuJoCo's direct format, (-stiffness, -damping).
  const auto set_impedance = [](mjtNum* solimp, double impedance) {
    solimp[0] = solimp[1] = impedance;
  };
  const auto set_reference = [](mjtNum* solref, double stiffness, double damping) {
    solref[0] = -stiffness;
    solref[1] = -damping;
  };
  // Only the contact spheres, whose contype is 0: they carry the robot on the floor.
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    if (model_->geom_contype[geom] != 0) continue;
    // R f = -k r - b v with R = (1 - d) / d A: multiplied by (1 - d) A, the spring k of the contact
    // becomes MuJoCo's reference stiffness per unit of inverse mass. The factor d cancels in direct
    // format, where MuJoCo divides by it (see above).
    const double inverse_mass = model_->body_invweight0[2 * model_->geom_bodyid[geom]];
    const double scale = (1 - kImpedance) * inverse_mass;
    // A geom with the higher priority decides the parameters of the contact alone.
    model_->geom_priority[geom] = 1;
    set_reference(&model_->geom_solref[mjNREF * geom], scale * world.materials.contact_stiffness,
                  scale * world.materials.contact_damping);
    set_impedance(&model_->geom_solimp[mjNIMP * geom], kImpedance);
  }
  // Dry friction and coupled joints are rigid: a velocity decays within one step (b = 1 / h), a gap
  // halves with each step (k = 1 / 2 h^2).
  const double h = world.step;
  for (int dof = 0; dof < model_->nv; ++dof) {
    set_reference(&model_->dof_solref[mjNREF * dof], kRigid / (h * h) / 2, kRigid / h);
    set_impedance(&model_->dof_solimp[mjNIMP * dof], kRigid);
  }
  for (int i = 0; i < model_->neq; ++i) {
    set_reference(&model_->eq_solref[mjNREF * i], kRigid / (h * h) / 2, kRigid / h);
    set_impedance(&model_->eq_solimp[mjNIMP * i], kRigid);
    // A mimic joint has the stops of the joint that it follows.
    model_->jnt_limited[model_->eq_obj1id[i]] = 0;
  }
  // The stops of joints, as the contacts above: with the joint's inverse inertia in place of the
  // body's inverse mass.
  for (int joint = 0; joint < model_->njnt; ++joint) {
    if (!model_->jnt_limited[joint]) continue;
    const double scale = (1 - kImpedance) * model_->dof_invweight0[model_->jnt_dofadr[joint]];
    set_reference(&model_->jnt_solref[mjNREF * joint], scale * kStopStiffness,
                  scale * kStopDamping);
    set_impedance(&model_->jnt_solimp[mjNIMP * joint], kImpedance);
  }
}

void MujocoBaseline::set_state(const Tree& tree, const TreeState& state) {
  mj_resetData(model_.get(), data_.get());
  robot_->write(tree, state, *model_, *data_);
  mj_forward(model_.get(), data_.get());
}

TreeState MujocoBaseline::state(const Tree& tree) const {
  TreeState state(tree.num_dofs());
  robot_->read(tree, *data_, state);
  return state;
}

// MuJoCo's force range bounds servo and damping, but not the joint's damping, which holds the
// back-EMF: a braking motor would exceed its current limit. An applied force takes the excess back,
// from the state at the start of the step.
void MujocoBaseline::limit_braking_torque() {
  for (int i = 0; i < model_->nu; ++i) {
    const int joint = model_->actuator_trnid[2 * i];
    const int dof = model_->jnt_dofadr[joint];
    const double speed = data_->qvel[dof];
    const double gain = model_->actuator_gainprm[mjNGAIN * i];
    const double damping = -model_->actuator_biasprm[mjNBIAS * i + 2];
    const double limit = model_->actuator_forcerange[2 * i + 1];
    const double error = data_->ctrl[i] - data_->qpos[model_->jnt_qposadr[joint]];
    const double driven = std::clamp(gain * error - damping * speed, -limit, limit);
    const double torque = driven - back_emf_[i] * speed;
    data_->qfrc_applied[dof] = std::clamp(torque, -limit, limit) - torque;
  }
}

void MujocoBaseline::step() {
  if (has_matched_laws_) limit_braking_torque();
  mj_step(model_.get(), data_.get());
}

void MujocoBaseline::set_targets(const Eigen::VectorXd& position) {
  for (size_t motor = 0; motor < actuator_of_motor_.size(); ++motor) {
    if (actuator_of_motor_[motor] < 0) continue;
    data_->ctrl[actuator_of_motor_[motor]] = position[static_cast<long>(motor)];
  }
}

}  // namespace nao::sim
