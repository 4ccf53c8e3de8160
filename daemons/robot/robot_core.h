#pragma once

#include <cstdint>

#include "daemons/robot/chest_button.h"
#include "daemons/robot/health_monitor.h"
#include "daemons/robot/lights.h"
#include "daemons/robot/measurement.h"
#include "daemons/robot/safety.h"
#include "daemons/robot/targets.h"
#include "lola/frame.h"
#include "lola/lola_map.h"
#include "robot_model/robot_model.h"
#include "robot_model/target_limiter.h"

namespace nao::robot {

/** nao-robot without clock, bus and socket: for each state frame one command frame.
 *
 * No joint target ever changes faster than its motor turns: a TargetLimiter is the last stage.
 * Neither take_frame() nor step() allocates. */
class RobotCore {
 public:
  struct Input {
    /** New targets that answer tick(), for all motors; nullptr: none. */
    const Targets* command = nullptr;
    /** A client drives the robot, for the eyes. */
    bool has_driver = false;
    /** The robot must sit down and go limp, and then the program ends. */
    bool is_ending = false;
  };

  /** @param model, map  Must outlive this. @param starts_itself  See Safety. */
  RobotCore(const RobotModel& model, const LolaMap& map, bool starts_itself);

  /** A state frame. @param num_periods  Periods since the last one; 0 for the first. */
  const Measurement& take_frame(const LolaState& state, int num_periods);
  /** The answer to it. */
  const LolaCommand& step(const Input& input);

  /** Number of the frame. It restarts at 0 when the robot begins to follow commands, and when it
   * stops following them: a controller then takes it for another robot and continues from what the
   * servos hold. */
  int64_t tick() const { return tick_; }
  const Measurement& measurement() const { return reader_.measurement(); }
  /** As sent last. */
  const Targets& targets() const { return targets_; }
  /** The stiffness that commands have set: 0 while the robot follows none. */
  double commanded_stiffness(int motor) const;
  const Safety& safety() const { return safety_; }
  const HealthMonitor& health() const { return health_; }
  const LolaMap& map() const { return map_; }
  Lights& lights() { return lights_; }
  const Lights& lights() const { return lights_; }

 private:
  const LolaMap& map_;
  MeasurementReader reader_;
  ChestButton button_;
  HealthMonitor health_;
  Safety safety_;
  TargetLimiter limiter_;
  Lights lights_;
  Targets targets_;
  Targets next_;
  LolaCommand command_;
  int64_t tick_ = -1;
  /** At the last frame. */
  bool was_driven_ = false;
  bool is_first_ = true;
};

}  // namespace nao::robot
