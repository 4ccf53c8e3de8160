#pragma once

#include <optional>
#include <vector>

#include "sim/mujoco_model.h"
#include "sim/sim_robot.h"
#include "sim/tree.h"

namespace nao::sim {

/** How the robot's feet collide with the floor in the baseline. */
enum class BaselineFeet {
  /** The same corner points as in our physics. */
  kPoints,
  /** A box each, as in a model written by hand: four contacts a foot. */
  kBoxes,
};

/** Laws of contact, dry friction and coupled joints in the baseline. */
enum class BaselineLaws {
  /** MuJoCo's defaults, which suit its step of 2 ms; pyramidal friction cone. */
  kMujoco,
  /** The laws of our physics: the same points with the same springs and dampers against the floor,
   * elliptic friction cone, the same joint stops and torque limit of a braking motor; dry friction
   * and coupled joints rigid. For steps of 0.1 ms or less, since MuJoCo's springs are explicit. Two
   * differences remain: a sticking contact has a damper along the surface in MuJoCo and a spring
   * here, and boxes have sharp edges in MuJoCo. */
  kMatched,
};

struct BaselineOptions {
  BaselineFeet feet = BaselineFeet::kPoints;
  BaselineLaws laws = BaselineLaws::kMujoco;
  /** Without servos and back-EMF. */
  bool is_limp = false;
};

/** A robot in MuJoCo, the baseline of benchmarks and cross-checks. Built only where MuJoCo is
 * installed. */
class MujocoBaseline {
 public:
  /** @throws Error  if MuJoCo does not accept the model. */
  MujocoBaseline(const SimRobot& robot, const WorldOptions& world,
                 const BaselineOptions& options = {});

  const mjModel& model() const { return *model_; }
  mjData& data() { return *data_; }
  /** Sets position and velocity, and clears the solver's warm start. */
  void set_state(const Tree& tree, const TreeState& state);
  /** Position and velocity in our generalized coordinates. */
  TreeState state(const Tree& tree) const;
  /** Targets of all servos, motor order. */
  void set_targets(const Eigen::VectorXd& position);
  /** One time step. */
  void step();

 private:
  void match_laws(const WorldOptions& world);

  /** Limits the torque of braking motors, to which back-EMF adds, to the largest torque. */
  void limit_braking_torque();

  bool has_matched_laws_;
  MujocoModelPointer model_;
  MujocoDataPointer data_;
  std::optional<MujocoRobot> robot_;
  std::vector<int> actuator_of_motor_;
  /** Back-EMF constant of each actuator, N m s/rad. */
  std::vector<double> back_emf_;
};

}  // namespace nao::sim
