#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/constants.h"
#include "daemons/motion/motion_core.h"
#include "test/daemons/motion/nao_model.h"

namespace nao::motion {

/** A robot whose joints reach each target within one control step and that never falls: enough for
 * everything that needs no physics. */
class PerfectRobot {
 public:
  /** @param period  Control period, s. */
  explicit PerfectRobot(const std::string& posture = "StandInit", double period = 0.01) {
    sensors_.period = period;
    sensors_.position = nao_model().find_posture(posture)->position;
    sensors_.velocity.assign(nao_model().num_motors(), 0.0);
    sensors_.torque.assign(nao_model().num_motors(), 0.0);
    sensors_.target_position = sensors_.position;
    sensors_.stiffness.assign(nao_model().num_motors(), 1.0);
    sensors_.foot_force.assign(nao_model().foot_sensors().size(), 6.5);
    update_accelerometer();
  }

  Sensors& sensors() { return sensors_; }

  /** Makes it lie from now on, at any joint angles. */
  void lie_on_belly() { lies_on_belly_ = true; }

  /** One control step of robot and core together. */
  Output step(MotionCore& core, std::vector<Command> commands = {},
              std::vector<TaughtChange> taught = {}) {
    update_accelerometer();
    sensors_.utime += std::lround(sensors_.period * 1e6);
    ++sensors_.tick;
    Input input;
    input.sensors = sensors_;
    input.commands = std::move(commands);
    input.taught = std::move(taught);
    Output output = core.step(input, sensors_.period);
    for (size_t i = 0; i < sensors_.position.size(); ++i) {
      const double position = output.joint_targets->position[i];
      sensors_.velocity[i] = (position - sensors_.position[i]) / sensors_.period;
      sensors_.position[i] = position;
    }
    sensors_.target_position = output.joint_targets->position;
    sensors_.stiffness = output.joint_targets->stiffness;
    return output;
  }

  /** Steps until the core has held its targets for 30 steps. @return All results on the way. */
  std::vector<CommandResult> settle(MotionCore& core, double seconds = 10) {
    std::vector<CommandResult> results;
    int num_still = 0;
    for (double time = 0; time < seconds && num_still < 30; time += sensors_.period) {
      const Output output = step(core);
      results.insert(results.end(), output.results.begin(), output.results.end());
      num_still = core.motion_state().mode == Mode::kHolding ? num_still + 1 : 0;
    }
    return results;
  }

 private:
  /** Gravity as a robot measures it whose left sole is level, or that lies on its belly. */
  void update_accelerometer() {
    if (lies_on_belly_) {
      sensors_.accelerometer_torso = {-kGravity, 0, 0};
      return;
    }
    const auto poses = nao_model().link_poses(sensors_.position);
    sensors_.accelerometer_torso = kGravity * poses[nao_model().left_sole()].linear().col(2);
  }

  Sensors sensors_;
  bool lies_on_belly_ = false;
};

}  // namespace nao::motion
