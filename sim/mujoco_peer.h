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
  /** Our physics': the same spring and damper at each point of the soles, a round cone, dry
   * friction and coupling as good as rigid. For steps of 0.1 ms and less, MuJoCo takes springs
   * explicitly. What is left: sticking soles creep against a damper there, and hang on a spring
   * here. */
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
  void step() { mj_step(model_, data_); }

 private:
  void take_our_laws(const SimRobot& robot, const WorldOptions& world);

  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  std::vector<int> joint_of_body_;
  std::vector<int> actuator_of_motor_;
};

}  // namespace nao::sim
