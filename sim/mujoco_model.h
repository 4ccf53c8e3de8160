#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

#include "sim/ball.h"
#include "sim/goal_shapes.h"
#include "sim/sim_robot.h"
#include "sim/tree.h"
#include "sim/world_options.h"

namespace nao::sim {

/** Contents of a MuJoCo model besides the floor. */
struct MujocoScene {
  std::vector<const SimRobot*> robots;
  /** nullptr: none. */
  const BallDescription* ball = nullptr;
  std::vector<StaticShape> statics;
};

struct MujocoModelOptions {
  /** Whether soles collide with the floor by the same points as in the fast engine, or by boxes, as
   * in a model written by hand: four contacts a foot. */
  bool has_sole_points = true;
  /** Whether all other shapes collide with the floor by points too. */
  bool has_points_only = false;
  /** Whether MuJoCo's actuators are the servos, and its joints have the motors' back-EMF. */
  bool has_servos = true;
  /** Whether the motors' friction is MuJoCo's too; otherwise it is set step by step. */
  bool has_friction = true;
  /** Whether each robot has its own friction on the floor, and another one on other shapes. */
  bool has_materials = false;
};

/** MJCF text of robots with the same bodies, masses, joints, motors (armature, friction, servo
 * whose whole demand is clipped to the largest torque, back-EMF as damping) and collision
 * primitives as in the fast engine, on the same floor. A robot on a stand has no free joint. */
std::string to_mjcf(const MujocoScene& scene, const WorldOptions& world,
                    const MujocoModelOptions& options);

struct MujocoDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using MujocoModelPointer = std::unique_ptr<mjModel, MujocoDeleter>;
using MujocoDataPointer = std::unique_ptr<mjData, MujocoDeleter>;

/** @throws Error  if MuJoCo does not accept the text. */
MujocoModelPointer load_mjcf(const std::string& text);

/** Names of bodies, joints and geoms in the text. */
std::string mujoco_body_name(int robot, int body);
std::string mujoco_joint_name(int robot, int body);

/** Where one robot's coordinates are in MuJoCo's vectors. */
class MujocoRobot {
 public:
  /** @param robot  Its index in the scene. */
  MujocoRobot(const mjModel& model, const SimRobot& sim_robot, int robot);

  /** Sets position and velocity. */
  void write(const Tree& tree, const TreeState& state, mjModel& model, mjData& data) const;
  /** Reads position and velocity; those of a fixed root are left as they are. */
  void read(const Tree& tree, const mjData& data, TreeState& state) const;
  /** MuJoCo's degree of freedom of ours, 6 or above. */
  int dof(int our_dof) const { return dof_address_[our_dof]; }
  /** MuJoCo's joint of a body's; -1 for the root. */
  int joint(int body) const { return joint_[body]; }
  /** MuJoCo's first six; -1 for a fixed root. */
  int root_dof() const { return root_dof_; }

 private:
  int root_body_;
  int root_position_ = -1;
  int root_dof_ = -1;
  /** Joint of each body, and its addresses in qpos and qvel. */
  std::vector<int> joint_;
  std::vector<int> position_address_;
  std::vector<int> velocity_address_;
  /** Address of each of our degrees of freedom. */
  std::vector<int> dof_address_;
};

/** Motor of a body's joint; -1 for the root and for mimic joints. */
int motor_of_body(const SimRobot& robot, int body);

}  // namespace nao::sim
