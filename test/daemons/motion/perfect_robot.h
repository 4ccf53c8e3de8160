#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "daemons/motion/motion_core.h"
#include "test/daemons/motion/nao_model.h"

namespace nao::motion {

/** A robot whose joints are where they were told to be one tick ago, and that never falls: enough
 * to test everything that is no physics. */
class PerfectRobot {
 public:
  explicit PerfectRobot(const std::string& posture = "StandInit") {
    sensors_.position = nao_model().find_posture(posture)->position;
    sensors_.velocity.assign(nao_model().num_motors(), 0.0);
    sensors_.torque.assign(nao_model().num_motors(), 0.0);
    sensors_.target_position = sensors_.position;
    sensors_.stiffness.assign(nao_model().num_motors(), 1.0);
    sensors_.foot_force.assign(nao_model().foot_sensors().size(), 6.5);
  }

  static constexpr double kTick = 0.01;

  Sensors& sensors() { return sensors_; }

  /** From now on it lies, whatever its joints do. */
  void lie_on_belly() { lies_on_belly_ = true; }

  /** One tick of robot and core together. */
  Output step(MotionCore& core, std::vector<Command> commands = {}) {
    stand_flat();
    sensors_.utime += 10000;
    ++sensors_.tick;
    Input input;
    input.sensors = sensors_;
    input.commands = std::move(commands);
    Output output = core.step(input, kTick);
    for (size_t i = 0; i < sensors_.position.size(); ++i) {
      const double position = output.joint_targets->position[i];
      sensors_.velocity[i] = (position - sensors_.position[i]) / kTick;
      sensors_.position[i] = position;
    }
    sensors_.target_position = output.joint_targets->position;
    sensors_.stiffness = output.joint_targets->stiffness;
    return output;
  }

  /** Steps until the core has been still for a moment. @return All results on the way. */
  std::vector<CommandResult> settle(MotionCore& core, double seconds = 10) {
    std::vector<CommandResult> results;
    int num_still = 0;
    for (double time = 0; time < seconds && num_still < 30; time += kTick) {
      const Output output = step(core);
      results.insert(results.end(), output.results.begin(), output.results.end());
      num_still = core.motion_state().mode == Mode::kHolding ? num_still + 1 : 0;
    }
    return results;
  }

 private:
  /** The accelerometer of a robot whose soles are level. */
  void stand_flat() {
    const auto poses = nao_model().link_poses(sensors_.position);
    if (lies_on_belly_) {
      sensors_.accelerometer_torso = {-9.81, 0, 0};
      return;
    }
    sensors_.accelerometer_torso = 9.81 * poses[nao_model().left_sole()].linear().col(2);
  }

  Sensors sensors_;
  bool lies_on_belly_ = false;
};

}  // namespace nao::motion
