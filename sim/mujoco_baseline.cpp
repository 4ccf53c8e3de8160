#include "sim/mujoco_baseline.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iomanip>
#include <set>
#include <sstream>

#include "common/error.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

std::string numbers(const Vector3d& v) {
  std::ostringstream text;
  text << std::setprecision(17) << v.x() << ' ' << v.y() << ' ' << v.z();
  return text.str();
}

std::string numbers(const Eigen::Quaterniond& q) {
  std::ostringstream text;
  text << std::setprecision(17) << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z();
  return text.str();
}

std::string body_name(int body) {
  return "body" + std::to_string(body);
}
std::string joint_name(int body) {
  return "joint" + std::to_string(body);
}

/** Motor of a body's joint; -1 for the root and for mimic joints. */
int motor_of_body(const SimRobot& robot, int body) {
  const RobotModel& model = robot.model();
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    if (model.motors()[motor] == robot.tree().bodies()[body].joint) return motor;
  }
  return -1;
}

/** Writes a body with its joint, inertia, shapes and descendants. */
void write_body(std::ostream& out, const SimRobot& robot, int index,
                const BaselineOptions& options) {
  const TreeBody& body = robot.tree().bodies()[index];
  const RobotModel& model = robot.model();
  out << "<body name=\"" << body_name(index) << "\" pos=\"" << numbers(body.origin_in_parent)
      << "\" quat=\"" << numbers(Eigen::Quaterniond(body.rotation_in_parent)) << "\">\n";
  if (body.parent < 0) {
    out << "<freejoint/>\n";
  } else {
    const Joint& joint = model.joints()[body.joint];
    const int motor = motor_of_body(robot, index);
    out << "<joint name=\"" << joint_name(index) << "\" axis=\"" << numbers(body.axis)
        << "\" limited=\"true\" range=\"" << joint.lower << ' ' << joint.upper << '"';
    if (motor >= 0) {
      const Motor& drive = model.motor(motor);
      out << " armature=\"" << drive.reflected_inertia << "\" frictionloss=\"" << drive.dry_friction
          << "\" damping=\""
          << drive.viscous_friction +
                 (options.is_limp ? 0 : drive.peak_torque / drive.no_load_velocity)
          << '"';
    }
    out << "/>\n";
  }
  const Eigen::Matrix3d& i = body.inertia;
  out << "<inertial pos=\"" << numbers(body.center_of_mass) << "\" mass=\"" << body.mass
      << "\" fullinertia=\"" << i(0, 0) << ' ' << i(1, 1) << ' ' << i(2, 2) << ' ' << i(0, 1) << ' '
      << i(0, 2) << ' ' << i(1, 2) << "\"/>\n";

  const CollisionModel& shapes = robot.collisions();
  for (const CollisionModel::Part& part : shapes.parts) {
    if (part.body != index) continue;
    const bool has_sole =
        part.first_point < part.end_point && shapes.points[part.first_point].sole >= 0;
    // Where points collide with the floor, the shape itself collides with other parts only.
    const bool is_off_floor = options.feet == BaselineFeet::kPoints &&
                              (has_sole || options.laws == BaselineLaws::kMatched);
    const Vector3d& half = part.half;
    out << "<geom contype=\"1\" conaffinity=\"" << (is_off_floor ? 1 : 3) << "\" pos=\""
        << numbers(part.center_in_body) << "\" quat=\""
        << numbers(Eigen::Quaterniond(part.rotation_in_body)) << '"';
    if (half.x() > 0) {
      out << " type=\"box\" size=\"" << numbers(half + Vector3d::Constant(part.radius)) << '"';
    } else if (half.z() > 0) {
      out << " type=\"capsule\" size=\"" << part.radius << ' ' << half.z() << '"';
    } else {
      out << " type=\"sphere\" size=\"" << part.radius << '"';
    }
    out << "/>\n";
    for (int p = part.first_point; is_off_floor && p < part.end_point; ++p) {
      const CollisionModel::Point& point = shapes.points[p];
      const double radius = std::max(point.radius, 1e-3);
      const Vector3d raised(0, 0, radius - point.radius);
      out << "<geom contype=\"0\" conaffinity=\"2\" type=\"sphere\" size=\"" << radius
          << "\" pos=\"" << numbers(point.center_in_body + raised) << "\"/>\n";
    }
  }
  for (int child = index + 1; child < robot.tree().num_bodies(); ++child) {
    if (robot.tree().bodies()[child].parent == index) write_body(out, robot, child, options);
  }
  out << "</body>\n";
}

}  // namespace

std::string to_mjcf(const SimRobot& robot, const WorldOptions& world,
                    const BaselineOptions& options) {
  std::ostringstream out;
  out << std::setprecision(17);
  out << "<mujoco><compiler angle=\"radian\"/>\n<option timestep=\"" << world.step
      << "\" gravity=\"" << numbers(world.gravity) << "\" solver=\"Newton\" cone=\"pyramidal\"/>\n"
      << "<size njmax=\"1000\" nconmax=\"200\"/>\n<default><geom condim=\"3\" friction=\""
      << world.materials.floor_friction << " 0.005 0.0001\"/></default>\n<worldbody>\n"
      << "<geom type=\"plane\" size=\"20 20 1\" contype=\"2\" conaffinity=\"0\"/>\n";
  write_body(out, robot, 0, options);
  out << "</worldbody>\n<contact>\n";
  // Pairs of bodies without self-collision.
  const CollisionModel& shapes = robot.collisions();
  std::set<std::pair<int, int>> touching;
  std::set<int> with_shapes;
  for (const auto& [a, b] : shapes.self_pairs) {
    touching.insert(std::minmax(shapes.parts[a].body, shapes.parts[b].body));
  }
  for (const CollisionModel::Part& part : shapes.parts) with_shapes.insert(part.body);
  for (const int a : with_shapes) {
    for (const int b : with_shapes) {
      if (a >= b || touching.count({a, b}) > 0) continue;
      out << "<exclude body1=\"" << body_name(a) << "\" body2=\"" << body_name(b) << "\"/>\n";
    }
  }
  out << "</contact>\n<equality>\n";
  const std::vector<TreeBody>& bodies = robot.tree().bodies();
  for (size_t i = 1; i < bodies.size(); ++i) {
    const int leader = robot.tree().body_of_dof(bodies[i].dof);
    if (leader == static_cast<int>(i)) continue;
    out << "<joint joint1=\"" << joint_name(static_cast<int>(i)) << "\" joint2=\""
        << joint_name(leader) << "\" polycoef=\"" << bodies[i].offset << ' ' << bodies[i].ratio
        << " 0 0 0\"/>\n";
  }
  out << "</equality>\n<actuator>\n";
  for (size_t i = 1; i < bodies.size(); ++i) {
    const int motor = motor_of_body(robot, static_cast<int>(i));
    if (motor < 0 || options.is_limp) continue;
    const Motor& drive = robot.model().motor(motor);
    // The limit applies to spring and damping together, as in Drive: clipping the spring alone
    // changes the distance of a walk (docs/performance.md).
    out << "<general joint=\"" << joint_name(static_cast<int>(i))
        << "\" biastype=\"affine\" gainprm=\"" << drive.stiffness_gain << "\" biasprm=\"0 "
        << -drive.stiffness_gain << ' ' << -drive.damping_gain
        << "\" forcelimited=\"true\" forcerange=\"" << -drive.peak_torque << ' '
        << drive.peak_torque << "\"/>\n";
  }
  out << "</actuator></mujoco>\n";
  return out.str();
}

MujocoBaseline::MujocoBaseline(const SimRobot& robot, const WorldOptions& world,
                               const BaselineOptions& options)
    : has_matched_laws_(options.laws == BaselineLaws::kMatched) {
  const std::string text = to_mjcf(robot, world, options);
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "robot.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[files->nfile - 1], text.data(), text.size());
  std::array<char, 1000> error{};
  model_ = mj_loadXML("robot.xml", files.get(), error.data(), error.size());
  mj_deleteVFS(files.get());
  if (model_ == nullptr) throw Error(std::string("MuJoCo: ") + error.data());
  if (has_matched_laws_) match_laws(world);
  data_ = mj_makeData(model_);

  const Tree& tree = robot.tree();
  joint_of_body_.assign(tree.num_bodies(), -1);
  actuator_of_motor_.assign(robot.model().num_motors(), -1);
  int actuator = 0;
  for (int i = 1; i < tree.num_bodies(); ++i) {
    joint_of_body_[i] = mj_name2id(model_, mjOBJ_JOINT, joint_name(i).c_str());
    const int motor = motor_of_body(robot, i);
    if (motor < 0 || options.is_limp) continue;
    actuator_of_motor_[motor] = actuator++;
    const Motor& drive = robot.model().motor(motor);
    back_emf_.push_back(drive.peak_torque / drive.no_load_velocity);
  }
  set_state(tree, robot.state());
  set_targets(robot.motor_position());
}

MujocoBaseline::~MujocoBaseline() {
  mj_deleteData(data_);
  mj_deleteModel(model_);
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
  const auto set_impedance = [](mjtNum* solimp, double impedance) {
    solimp[0] = solimp[1] = impedance;
  };
  const auto set_reference = [](mjtNum* solref, double stiffness, double damping) {
    solref[0] = -stiffness;
    solref[1] = -damping;
  };
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    if (model_->geom_contype[geom] != 0) continue;
    const double inverse_mass = model_->body_invweight0[2 * model_->geom_bodyid[geom]];
    const double scale = (1 - kImpedance) * inverse_mass;
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
  for (int joint = 0; joint < model_->njnt; ++joint) {
    if (!model_->jnt_limited[joint]) continue;
    const double scale = (1 - kImpedance) * model_->dof_invweight0[model_->jnt_dofadr[joint]];
    set_reference(&model_->jnt_solref[mjNREF * joint], scale * kStopStiffness,
                  scale * kStopDamping);
    set_impedance(&model_->jnt_solimp[mjNIMP * joint], kImpedance);
  }
}

void MujocoBaseline::set_state(const Tree& tree, const TreeState& state) {
  mj_resetData(model_, data_);
  const Eigen::Quaterniond& q = state.orientation;
  const double orientation[] = {q.w(), q.x(), q.y(), q.z()};
  // MuJoCo's angular velocity of a free joint is in the body's own axes.
  const Vector3d turning = q.conjugate() * Vector3d(state.velocity.head<3>());
  for (int k = 0; k < 3; ++k) {
    data_->qpos[k] = state.position[k];
    data_->qvel[k] = state.velocity[3 + k];
    data_->qvel[3 + k] = turning[k];
  }
  for (int k = 0; k < 4; ++k) data_->qpos[3 + k] = orientation[k];
  for (int i = 1; i < tree.num_bodies(); ++i) {
    const TreeBody& body = tree.bodies()[i];
    data_->qpos[model_->jnt_qposadr[joint_of_body_[i]]] =
        body.ratio * state.coordinate[body.dof] + body.offset;
    data_->qvel[model_->jnt_dofadr[joint_of_body_[i]]] = body.ratio * state.velocity[body.dof];
  }
  mj_forward(model_, data_);
}

TreeState MujocoBaseline::state(const Tree& tree) const {
  TreeState state(tree.num_dofs());
  state.position = {data_->qpos[0], data_->qpos[1], data_->qpos[2]};
  state.orientation =
      Eigen::Quaterniond(data_->qpos[3], data_->qpos[4], data_->qpos[5], data_->qpos[6]);
  for (int k = 0; k < 3; ++k) state.velocity[3 + k] = data_->qvel[k];
  state.velocity.head<3>() =
      state.orientation * Vector3d(data_->qvel[3], data_->qvel[4], data_->qvel[5]);
  for (int dof = 6; dof < tree.num_dofs(); ++dof) {
    const int joint = joint_of_body_[tree.body_of_dof(dof)];
    state.coordinate[dof] = data_->qpos[model_->jnt_qposadr[joint]];
    state.velocity[dof] = data_->qvel[model_->jnt_dofadr[joint]];
  }
  return state;
}

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
  mj_step(model_, data_);
}

void MujocoBaseline::set_targets(const Eigen::VectorXd& position) {
  for (size_t motor = 0; motor < actuator_of_motor_.size(); ++motor) {
    if (actuator_of_motor_[motor] < 0) continue;
    data_->ctrl[actuator_of_motor_[motor]] = position[static_cast<long>(motor)];
  }
}

}  // namespace nao::sim
