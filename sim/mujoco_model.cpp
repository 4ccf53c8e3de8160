#include "sim/mujoco_model.h"

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

// 17 digits, so that MuJoCo's numbers are the same as ours bit by bit.
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

// The first robot's names have no prefix, so that the model of a single robot is easy to read.
std::string prefix(int robot) {
  return robot == 0 ? "" : "robot" + std::to_string(robot) + "_";
}

// Bits of contype and conaffinity: two geoms collide if a bit of the one's first is among the
// other's second.
/** Shapes of robots and goals, and the ball. */
constexpr int kShapeBit = 1;
/** The floor: with points, shapes without points, and the ball. */
constexpr int kFloorBit = 2;
/** Nets: with the ball. */
constexpr int kNetBit = 4;

// MuJoCo has no rounded boxes: a box gets the radius on all sides, a box without width is a capsule
// along z, and a point a sphere.
void write_shape_size(std::ostream& out, const Vector3d& half, double radius) {
  if (half.x() > 0) {
    out << " type=\"box\" size=\"" << numbers(half + Vector3d::Constant(radius)) << '"';
  } else if (half.z() > 0) {
    out << " type=\"capsule\" size=\"" << radius << ' ' << half.z() << '"';
  } else {
    out << " type=\"sphere\" size=\"" << radius << '"';
  }
}

/** Writes the text of one model. */
class Writer {
 public:
  Writer(const MujocoScene& scene, const WorldOptions& world, const MujocoModelOptions& options)
      : scene_(scene), world_(world), options_(options) {
    out_ << std::setprecision(17);
  }

  std::string write() {
    const size_t num_robots = std::max<size_t>(1, scene_.robots.size());
    // Solver and cone are MuJoCo's defaults, written out. njmax and nconmax: memory for the
    // constraint rows and contacts of each robot.
    out_ << "<mujoco><compiler angle=\"radian\"/>\n<option timestep=\"" << world_.step
         << "\" gravity=\"" << numbers(world_.gravity)
         << "\" solver=\"Newton\" cone=\"pyramidal\"/>\n<size njmax=\"" << 1000 * num_robots
         << "\" nconmax=\"" << 200 * num_robots << "\" nuser_geom=\"" << kFloorData
         << "\"/>\n<default><geom condim=\"3\" friction=\"" << world_.materials.floor_friction
         << " 0.005 0.0001\"/></default>\n<worldbody>\n";
    write_floor();
    for (const StaticShape& shape : scene_.statics) write_static(shape);
    for (size_t i = 0; i < scene_.robots.size(); ++i) write_body(static_cast<int>(i), 0);
    if (scene_.ball != nullptr) write_ball();
    out_ << "</worldbody>\n<contact>\n";
    for (size_t i = 0; i < scene_.robots.size(); ++i) write_excluded_pairs(static_cast<int>(i));
    out_ << "</contact>\n<equality>\n";
    for (size_t i = 0; i < scene_.robots.size(); ++i) write_couplings(static_cast<int>(i));
    out_ << "</equality>\n<actuator>\n";
    for (size_t i = 0; i < scene_.robots.size() && options_.has_servos; ++i) {
      write_servos(static_cast<int>(i));
    }
    out_ << "</actuator></mujoco>\n";
    return out_.str();
  }

 private:
  /** Numbers of the floor's geom for collide_with_floor(). */
  static constexpr int kFloorData = 3;

  const SimRobot& robot(int index) const { return *scene_.robots[static_cast<size_t>(index)]; }

  void write_floor() {
    out_ << "<geom name=\"floor\" type=\"plane\" size=\"20 20 1\" contype=\"" << kFloorBit
         << "\" conaffinity=\"0\"";
    // MuJoCo takes the greater friction of two geoms.
    if (options_.has_materials) out_ << " friction=\"0.001 0.005 0.0001\"";
    const FloorOptions& floor = world_.floor;
    // The plane is at the height of the highest bump: MuJoCo considers only spheres that reach
    // below it.
    out_ << " pos=\"0 0 " << floor.bump_height << "\" user=\"" << floor.bump_height << ' '
         << floor.bump_grid << ' ' << floor.seed << "\"/>\n";
  }

  void write_static(const StaticShape& fixed) {
    const RoundedBox& shape = fixed.shape;
    out_ << "<geom name=\"" << (fixed.is_net ? "net" : "goal") << num_statics_++ << "\" contype=\""
         << (fixed.is_net ? kNetBit : 0) << "\" conaffinity=\"" << (fixed.is_net ? 0 : kShapeBit)
         << "\" friction=\"" << world_.materials.robot_friction << " 0.005 0.0001\" pos=\""
         << numbers(shape.center) << "\" quat=\"" << numbers(Eigen::Quaterniond(shape.rotation))
         << '"';
    write_shape_size(out_, shape.half, shape.radius);
    out_ << "/>\n";
  }

  void write_ball() {
    const BallDescription& ball = *scene_.ball;
    const Materials& materials = world_.materials;
    // A damped oscillation of damping ratio 0.22 returns exp(-pi 0.22 / sqrt(1 - 0.22^2)) = 0.49 of
    // the speed after half a period.
    out_ << "<body name=\"ball\"><freejoint name=\"ball\"/><geom name=\"ball\" type=\"sphere\" "
         << "size=\"" << ball.radius << "\" mass=\"" << ball.mass << "\" contype=\"" << kShapeBit
         << "\" conaffinity=\"" << (kShapeBit | kFloorBit | kNetBit)
         << "\" condim=\"3\" priority=\"1\" solref=\"0.02 0.22\" friction=\""
         << materials.ball_friction << " 0.005 0.0001\"/></body>\n";
  }

  // Joint of a tree body. Its damping includes the back-EMF as a viscous term where the model has
  // servos of its own; dry friction is MuJoCo's frictionloss.
  void write_joint(int index, int body_index) {
    const TreeBody& body = robot(index).tree().bodies()[body_index];
    const Joint& joint = robot(index).model().joints()[body.joint];
    const int motor = motor_of_body(robot(index), body_index);
    out_ << "<joint name=\"" << mujoco_joint_name(index, body_index) << "\" axis=\""
         << numbers(body.axis) << "\" limited=\"true\" range=\"" << joint.lower << ' '
         << joint.upper << '"';
    if (motor >= 0) {
      const Motor& drive = robot(index).model().motor(motor);
      out_ << " armature=\"" << drive.reflected_inertia << '"';
      if (options_.has_friction) {
        const double back_emf =
            options_.has_servos ? drive.peak_torque / drive.no_load_velocity : 0;
        out_ << " frictionloss=\"" << drive.dry_friction << "\" damping=\""
             << drive.viscous_friction + back_emf << '"';
      }
    }
    out_ << "/>\n";
  }

  void write_part(int index, const CollisionModel::Part& part) {
    const CollisionModel& shapes = robot(index).collisions();
    const bool has_sole =
        part.first_point < part.end_point && shapes.points[part.first_point].sole >= 0;
    // Where points collide with the floor, the shape itself collides with other shapes only.
    const bool has_points = options_.has_points_only || (options_.has_sole_points && has_sole);
    out_ << "<geom contype=\"" << kShapeBit << "\" conaffinity=\""
         << (has_points ? kShapeBit : kShapeBit | kFloorBit) << "\" pos=\""
         << numbers(part.center_in_body) << "\" quat=\""
         << numbers(Eigen::Quaterniond(part.rotation_in_body)) << '"';
    if (options_.has_materials) {
      out_ << " user=\"" << part.link << " -1\" friction=\"" << world_.materials.robot_friction
           << " 0.005 0.0001\"";
    }
    write_shape_size(out_, part.half, part.radius);
    out_ << "/>\n";
    for (int p = part.first_point; has_points && p < part.end_point; ++p) {
      // MuJoCo has no points: a sphere of at least 1 mm, raised so that its lowest point is at the
      // same height.
      const CollisionModel::Point& point = shapes.points[p];
      const double radius = std::max(point.radius, 1e-3);
      const Vector3d raised(0, 0, radius - point.radius);
      out_ << "<geom contype=\"0\" conaffinity=\"" << kFloorBit << "\" type=\"sphere\" size=\""
           << radius << "\" pos=\"" << numbers(point.center_in_body + raised) << '"';
      if (options_.has_materials) {
        out_ << " user=\"" << part.link << ' ' << point.sole << "\" friction=\""
             << world_.materials.floor_friction * robot(index).options().friction_scale
             << " 0.005 0.0001\"";
      }
      out_ << "/>\n";
    }
  }

  /** Writes a body with its joint, inertia, shapes and descendants. */
  void write_body(int index, int body_index) {
    const Tree& tree = robot(index).tree();
    const TreeBody& body = tree.bodies()[body_index];
    out_ << "<body name=\"" << mujoco_body_name(index, body_index) << "\" pos=\""
         << numbers(body.origin_in_parent) << "\" quat=\""
         << numbers(Eigen::Quaterniond(body.rotation_in_parent)) << "\">\n";
    if (body.parent >= 0) {
      write_joint(index, body_index);
    } else if (!robot(index).options().is_on_stand) {
      out_ << "<freejoint name=\"" << mujoco_joint_name(index, 0) << "\"/>\n";
    }
    const Eigen::Matrix3d& i = body.inertia;
    out_ << "<inertial pos=\"" << numbers(body.center_of_mass) << "\" mass=\"" << body.mass
         << "\" fullinertia=\"" << i(0, 0) << ' ' << i(1, 1) << ' ' << i(2, 2) << ' ' << i(0, 1)
         << ' ' << i(0, 2) << ' ' << i(1, 2) << "\"/>\n";
    for (const CollisionModel::Part& part : robot(index).collisions().parts) {
      if (part.body == body_index) write_part(index, part);
    }
    for (int child = body_index + 1; child < tree.num_bodies(); ++child) {
      if (tree.bodies()[child].parent == body_index) write_body(index, child);
    }
    out_ << "</body>\n";
  }

  /** Excludes by name the pairs of bodies that may collide by contype and conaffinity but are not
   * self-collision pairs of the collision model. MuJoCo itself excludes only parent and child. */
  void write_excluded_pairs(int index) {
    const CollisionModel& shapes = robot(index).collisions();
    std::set<std::pair<int, int>> touching;
    std::set<int> with_shapes;
    for (const auto& [a, b] : shapes.self_pairs) {
      touching.insert(std::minmax(shapes.parts[a].body, shapes.parts[b].body));
    }
    for (const CollisionModel::Part& part : shapes.parts) with_shapes.insert(part.body);
    for (const int a : with_shapes) {
      for (const int b : with_shapes) {
        if (a >= b || touching.count({a, b}) > 0) continue;
        out_ << "<exclude body1=\"" << mujoco_body_name(index, a) << "\" body2=\""
             << mujoco_body_name(index, b) << "\"/>\n";
      }
    }
  }

  void write_couplings(int index) {
    const Tree& tree = robot(index).tree();
    for (int i = 1; i < tree.num_bodies(); ++i) {
      const TreeBody& body = tree.bodies()[i];
      // A mimic joint: q = offset + ratio * q_leader, as a soft equality of MuJoCo.
      const int leader = tree.body_of_dof(body.dof);
      if (leader == i) continue;
      out_ << "<joint joint1=\"" << mujoco_joint_name(index, i) << "\" joint2=\""
           << mujoco_joint_name(index, leader) << "\" polycoef=\"" << body.offset << ' '
           << body.ratio << " 0 0 0\"/>\n";
    }
  }

  void write_servos(int index) {
    for (int i = 1; i < robot(index).tree().num_bodies(); ++i) {
      const int motor = motor_of_body(robot(index), i);
      if (motor < 0) continue;
      const Motor& drive = robot(index).model().motor(motor);
      // The limit applies to spring and damping together, as in Drive: clipping the spring alone
      // changes the distance of a walk (docs/performance.md).
      // Affine bias: force = kp ctrl - kp q - kd q', the servo's PD law.
      out_ << "<general joint=\"" << mujoco_joint_name(index, i)
           << "\" biastype=\"affine\" gainprm=\"" << drive.stiffness_gain << "\" biasprm=\"0 "
           << -drive.stiffness_gain << ' ' << -drive.damping_gain
           << "\" forcelimited=\"true\" forcerange=\"" << -drive.peak_torque << ' '
           << drive.peak_torque << "\"/>\n";
    }
  }

  const MujocoScene& scene_;
  const WorldOptions& world_;
  MujocoModelOptions options_;
  std::ostringstream out_;
  int num_statics_ = 0;
};

}  // namespace

// Linear search: only at start.
int motor_of_body(const SimRobot& robot, int body) {
  const RobotModel& model = robot.model();
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    if (model.motors()[motor] == robot.tree().bodies()[body].joint) return motor;
  }
  return -1;
}

std::string mujoco_body_name(int robot, int body) {
  return prefix(robot) + "body" + std::to_string(body);
}

std::string mujoco_joint_name(int robot, int body) {
  return prefix(robot) + "joint" + std::to_string(body);
}

std::string to_mjcf(const MujocoScene& scene, const WorldOptions& world,
                    const MujocoModelOptions& options) {
  return Writer(scene, world, options).write();
}

// MuJoCo reads XML from a file only: the virtual file system holds the text in memory.
MujocoModelPointer load_mjcf(const std::string& text) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "robot.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[files->nfile - 1], text.data(), text.size());
  std::array<char, 1000> error{};
  MujocoModelPointer model(mj_loadXML("robot.xml", files.get(), error.data(), error.size()));
  mj_deleteVFS(files.get());
  if (model == nullptr) throw Error(std::string("MuJoCo: ") + error.data());
  return model;
}

MujocoRobot::MujocoRobot(const mjModel& model, const SimRobot& sim_robot, int robot)
    : root_body_(mj_name2id(&model, mjOBJ_BODY, mujoco_body_name(robot, 0).c_str())) {
  const Tree& tree = sim_robot.tree();
  const int root = mj_name2id(&model, mjOBJ_JOINT, mujoco_joint_name(robot, 0).c_str());
  if (root >= 0) {
    root_position_ = model.jnt_qposadr[root];
    root_dof_ = model.jnt_dofadr[root];
  }
  // Addresses by name: MuJoCo orders bodies depth first, the tree by its own rule.
  joint_.assign(tree.num_bodies(), -1);
  position_address_ = velocity_address_ = joint_;
  dof_address_.assign(tree.num_dofs(), -1);
  for (int i = 1; i < tree.num_bodies(); ++i) {
    joint_[i] = mj_name2id(&model, mjOBJ_JOINT, mujoco_joint_name(robot, i).c_str());
    position_address_[i] = model.jnt_qposadr[joint_[i]];
    velocity_address_[i] = model.jnt_dofadr[joint_[i]];
  }
  // Dofs 0..5 are the root's; each further one belongs to the body whose joint is not a mimic
  // joint.
  for (int dof = 6; dof < tree.num_dofs(); ++dof) {
    dof_address_[dof] = velocity_address_[tree.body_of_dof(dof)];
  }
}

void MujocoRobot::write(const Tree& tree, const TreeState& state, mjModel& model,
                        mjData& data) const {
  const Eigen::Quaterniond& q = state.orientation;
  const double orientation[] = {q.w(), q.x(), q.y(), q.z()};
  // MuJoCo's angular velocity of a free joint is in the body's own axes.
  const Vector3d turning = q.conjugate() * Vector3d(state.velocity.head<3>());
  if (root_dof_ >= 0) {
    for (int k = 0; k < 3; ++k) {
      data.qpos[root_position_ + k] = state.position[k];
      data.qvel[root_dof_ + k] = state.velocity[3 + k];
      data.qvel[root_dof_ + 3 + k] = turning[k];
    }
    for (int k = 0; k < 4; ++k) data.qpos[root_position_ + 3 + k] = orientation[k];
  } else {
    // A robot on a stand has no free joint: the pose of its root body in the model is changed.
    for (int k = 0; k < 3; ++k) model.body_pos[3 * root_body_ + k] = state.position[k];
    for (int k = 0; k < 4; ++k) model.body_quat[4 * root_body_ + k] = orientation[k];
  }
  // Mimic joints have coordinates of their own in MuJoCo, and start consistent with their leader.
  for (int i = 1; i < tree.num_bodies(); ++i) {
    const TreeBody& body = tree.bodies()[i];
    data.qpos[position_address_[i]] = body.ratio * state.coordinate[body.dof] + body.offset;
    data.qvel[velocity_address_[i]] = body.ratio * state.velocity[body.dof];
  }
}

void MujocoRobot::read(const Tree& tree, const mjData& data, TreeState& state) const {
  if (root_dof_ >= 0) {
    const mjtNum* q = data.qpos + root_position_;
    const mjtNum* v = data.qvel + root_dof_;
    state.position = {q[0], q[1], q[2]};
    state.orientation = Eigen::Quaterniond(q[3], q[4], q[5], q[6]);
    state.velocity.segment<3>(3) = Vector3d(v[0], v[1], v[2]);
    state.velocity.head<3>() = state.orientation * Vector3d(v[3], v[4], v[5]);
  }
  for (int dof = 6; dof < tree.num_dofs(); ++dof) {
    const int body = tree.body_of_dof(dof);
    state.coordinate[dof] = data.qpos[position_address_[body]];
    state.velocity[dof] = data.qvel[velocity_address_[body]];
  }
}

}  // namespace nao::sim
