#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lola/frame.h"
#include "lola/lola_map.h"
#include "robot_model/robot_model.h"
#include "sim/joint_command.h"
#include "sim/motor_targets.h"
#include "sim/sensors.h"

namespace nao::sim {

/** A simulated robot behind LoLA, the interface of a NAO V6: state frames from what it measures,
 * joint targets from commands, and what the physics does not have: lights, buttons, sonars,
 * currents, temperatures, a battery. Without socket and clock. */
class LolaRobot {
 public:
  /** @throws ModelError  if the model has no lola.yaml. */
  explicit LolaRobot(const RobotModel& model);

  /** Measures at the end of a control tick. Accelerometer and gyroscope are read in turns, each in
   * every other tick, as on the robot. @param targets  That the servos hold. @param period  s. */
  void update(const SensorReadings& sensed, const MotorTargets& targets, double period);
  /** The newest frame. */
  const LolaState& state() const { return state_; }

  /** Takes the keys of a command; keys that it lacks, or whose values are not finite, keep theirs.
   * @param targets  What the servos hold. @return Targets of all joints, as answer to a tick. */
  JointCommand take(const LolaCommand& command, const MotorTargets& targets, int64_t tick);

  /** Presses a button or touches a sensor for so many ticks from now on.
   * @return false if there is none of that name. */
  bool touch(const std::string& name, int64_t num_ticks);

  const LolaMap& map() const { return map_; }
  /** The newest value of every key that a command had; lights are those of this command. */
  const LolaCommand& held() const { return held_; }

 private:
  void read_joints(const SensorReadings& sensed, const MotorTargets& targets, double period);

  LolaMap map_;
  std::vector<std::string> motor_names_;
  LolaState state_;
  LolaCommand held_;
  /** Ticks for which each touch sensor is still touched. */
  std::array<int64_t, 14> touched_ticks_{};
};

}  // namespace nao::sim
