#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "sim/sim_robot.h"
#include "sim/tree.h"

namespace nao::sim {

/** How the robot's feet touch the floor in the peer. */
enum class PeerFeet {
  /** The same corner points as in our physics. */
  kPoints,
  /** A box each, as one would write it by hand: four contacts a foot. */
  kBoxes,
};

/** MJCF text of a robot as our physics sees it: the same bodies, masses, joints, motors (reflected
 * inertia, friction, servo, greatest torque, back-EMF as damping) and collision primitives, on the
 * same floor. Left to MuJoCo are the solver (Newton, pyramidal cone), the contact's softness (its
 * defaults) and the coupling of the two hip yaw-pitch joints (an equality constraint).
 * @param is_limp  Without servos and back-EMF. */
std::string to_mjcf(const SimRobot& robot, const WorldOptions& world, PeerFeet feet,
                    bool is_limp = false);

/** The same robot in MuJoCo, for comparisons. Only built where MuJoCo is installed. */
class MujocoPeer {
 public:
  /** @throws Error  if MuJoCo refuses the model. */
  MujocoPeer(const SimRobot& robot, const WorldOptions& world, PeerFeet feet, bool is_limp = false);
  ~MujocoPeer();
  MujocoPeer(const MujocoPeer&) = delete;
  MujocoPeer& operator=(const MujocoPeer&) = delete;

  const mjModel& model() const { return *model_; }
  mjData& data() { return *data_; }
  /** Takes over position and velocity, and forgets the solver's warm start. */
  void set_state(const Tree& tree, const TreeState& state);
  /** Position and velocity in our coordinates. */
  TreeState state(const Tree& tree) const;
  /** Targets of all servos, motor order. */
  void set_targets(const Eigen::VectorXd& position);
  /** One time step. */
  void step() { mj_step(model_, data_); }

 private:
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  std::vector<int> joint_of_body_;
  std::vector<int> actuator_of_motor_;
};

}  // namespace nao::sim
