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

/** What contacts, dry friction and the coupling of the hips are like in the peer. */
enum class PeerLaws {
  /** MuJoCo's defaults, which suit its step of 2 ms; contacts in a pyramidal cone. */
  kMujoco,
  /** Our physics': the floor meets the same points with the same springs and dampers, in a round
   * cone; the same joint stops and torque of a braking motor; dry friction and the coupling of the
   * hips rigid. For steps of 0.1 ms and less, MuJoCo takes springs explicitly. What is left: what
   * sticks on the floor creeps against a damper there, and hangs on a spring here; parts that meet
   * each other have sharp edges there. */
  kOurs,
};

struct PeerOptions {
  PeerFeet feet = PeerFeet::kPoints;
  PeerLaws laws = PeerLaws::kMujoco;
  /** Without servos and back-EMF. */
  bool is_limp = false;
};

/** MJCF text of a robot as our physics sees it: the same bodies, masses, joints, motors (reflected
 * inertia, friction, servo whose whole demand is clipped to the greatest torque, back-EMF as
 * damping) and collision primitives, on the same floor. */
std::string to_mjcf(const SimRobot& robot, const WorldOptions& world, const PeerOptions& options);

/** The same robot in MuJoCo, for comparisons. Only built where MuJoCo is installed. */
class MujocoPeer {
 public:
  /** @throws Error  if MuJoCo refuses the model. */
  MujocoPeer(const SimRobot& robot, const WorldOptions& world, const PeerOptions& options = {});
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
  void step();

 private:
  void take_our_laws(const WorldOptions& world);

  /** Takes off what back-EMF adds to a braking motor's greatest torque. */
  void limit_brakes();

  bool has_our_laws_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  std::vector<int> joint_of_body_;
  std::vector<int> actuator_of_motor_;
  /** Of each actuator, N m s/rad. */
  std::vector<double> back_emf_;
};

}  // namespace nao::sim
