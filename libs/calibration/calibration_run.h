#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "calibration/calibration_estimator.h"
#include "calibration/standing_sample.h"
#include "messages/command.h"
#include "robot_model/robot_model.h"

namespace nao {

/** A command of a calibration. */
using CalibrationCommand = std::variant<PostureCommand, JointChangeCommand, MoveToCommand>;

/** The motions of a robot that is being calibrated, and its measurements: it stands, shifts its
 * weight over both feet in eleven poses, turns by 90 degrees in place, and repeats that, so that
 * slope and bumps of the floor do not appear as errors of the robot.
 *
 * No bus, clock or thread. The user sends next_command() whenever there is one, reports its end,
 * and passes all sensor readings, until is_done(). */
class CalibrationRun {
 public:
  /** @param num_stations  Number of directions in which it stands, 1 to 8.
   * @throws ModelError  if the model's legs cannot be solved. */
  CalibrationRun(const RobotModel& model, int num_stations);

  /** The next command, once, when one is due. */
  std::optional<CalibrationCommand> next_command();
  /** The command has ended. @param fault  Why it was not executed; empty if it was. */
  void end_command(const std::string& fault);
  /** Takes in one tick. @param sample  Sample of the sensors; its station and heading are ignored.
   * @param dt  Time since the last one, s. */
  void measure(StandingSample sample, double dt);

  bool is_done() const { return phase_ == Phase::kDone; }
  /** Why it ended early: commands failed too often. Empty if it did not. */
  const std::string& fault() const { return fault_; }
  /** Fraction of the stands that were measured. */
  double progress() const;
  /** Stands so far; solve() makes the calibration. */
  CalibrationEstimator& estimator() { return estimator_; }

 private:
  enum class Phase { kReady, kMoving, kSettling, kMeasuring, kDone };
  /** Turns by `turn`, if it is not 0, and stands upright, or moves the legs to a pose. */
  struct Step {
    double turn = 0;
    std::vector<double> position;
  };

  void advance();

  const RobotModel* model_;
  CalibrationEstimator estimator_;
  std::vector<int> motors_;
  std::vector<Step> steps_;
  size_t step_ = 0;
  Phase phase_ = Phase::kReady;
  double time_ = 0;
  SampleMean mean_;
  int station_ = 0;
  double heading_ = 0;
  int num_faults_ = 0;
  std::string fault_;
};

}  // namespace nao
