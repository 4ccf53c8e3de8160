#pragma once

#include <cstdint>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/event_loop.h"
#include "common/second_process.h"
#include "common/status_reporter.h"
#include "daemons/motion/motion_core.h"
#include "daemons/motion/sensor_owner.h"
#include "messages/result_reminder.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** The motion core on the bus: one control step for every NAO_SENSOR_STATE, answered with its tick.
 * A repeated state gets the same answer again without another step. A simulator would obey two such
 * programs in turns, so one that begins while another runs for the same robot ends with an Error
 * from the loop. */
class MotionDaemon {
 public:
  /** Subscribes to the channels.
   * @param bus, loop, model  Must outlive this. @param robot  Prefix of its channels. */
  MotionDaemon(Bus& bus, EventLoop& loop, const RobotModel& model, const MotionOptions& options,
               const std::string& robot);

  /** Control steps since the start. */
  int64_t num_steps() const { return num_steps_; }

 private:
  template <class Message>
  void subscribe_to_command(const std::string& channel);
  void take_sensor_state(const naolcm::sensor_state_t& message);
  void check_for_silence();
  /** A command is there: a simulator whose world rests sends its state at once. */
  void wake_simulator();
  void step(std::optional<Sensors> sensors, double dt);
  void publish(const Output& output);
  void publish(const CommandResult& result);
  void publish_status();

  Bus& bus_;
  EventLoop& loop_;
  int silence_timer_ = -1;
  const RobotModel& model_;
  RobotChannels channels_;
  StatusReporter status_;
  SecondProcess second_process_;
  MotionCore core_;
  SensorOwner owner_;
  ResultReminder reminder_;
  /** Commands for the next step. */
  std::vector<Command> commands_;
  std::vector<TaughtChange> taught_;
  /** The newest one that nao-vision knew. */
  std::optional<SeenBall> ball_;
  int64_t num_steps_ = 0;
  int64_t num_missed_ticks_ = 0;
  /** Time of the last sensor state, microseconds, its control period, and the robot time since the
   * one before it, s. */
  int64_t last_utime_ = 0;
  double last_period_ = 0;
  double last_interval_ = 0;
  int64_t last_tick_ = -1;
  /** Answer to the last sensor state. */
  std::optional<naolcm::joint_command_t> last_answer_;
  /** The last result of a command, as it was logged. */
  std::string last_result_line_;
  /** Wall time of the last step with sensor data, and of the last one without, s. */
  double last_step_time_ = 0;
  double last_silent_step_time_ = 0;
  // Since the last status: the longest computation of a step, s of wall time, and s of robot time.
  double worst_step_seconds_ = 0;
  double robot_time_ = 0;
};

}  // namespace nao::motion
