#pragma once

#include <optional>
#include <vector>

#include "daemons/motion/robot_state.h"
#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Turns the ankles against a pitch of the body that its joint targets do not command, while it
 * rises over its soles.
 *
 * With flat soles the targets alone decide how fast the torso pitches. A body that pitches faster,
 * since its servos are softer or stiffer than those for which the keyframes were found, tips over
 * an edge of its soles. Each ankle turns by gain * (w - w_targets), with the measured pitch rate w
 * and the targets' w_targets, which moves the center of pressure towards that edge. */
class AnkleDamping {
 public:
  /** @param model  Must outlive this. @throws ModelError  as LegKinematics. */
  explicit AnkleDamping(const RobotModel& model) : kinematics_(model), legs_(model) {}

  /** Adds the ankles' angles to the targets; to be called in every control step.
   * @param gain  Angle per angular velocity, s; 0: adds nothing.
   * @param dt  s since the last step. @param position  Targets, rad, (num_motors). */
  void add_to(const RobotState& state, double gain, double dt, std::vector<double>& position);

 private:
  /** Of the targets. */
  Kinematics kinematics_;
  LegKinematics legs_;
  /** Pitch of the torso over flat soles in the last step, rad. */
  std::optional<double> last_pitch_;
};

}  // namespace nao::motion
