#pragma once

#include <limits>

#include "daemons/motion/falls/fall_monitor.h"
#include "daemons/motion/motion_options.h"
#include "daemons/motion/robot_state.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Decides when the robot falls, has fallen, gets up by itself, and needs help.
 *
 * A robot on its feet falls when FallMonitor predicts so. A robot that lies without having been
 * commanded to has fallen, too (it was knocked over while nothing ran). After a fall it gets up
 * once it has lain for MotionOptions::get_up_delay. When the get-up motion finally fails, the robot
 * needs help and does not try again until it is lifted or commanded. */
class FallSupervisor {
 public:
  /** @param model, options  Must outlive this. */
  FallSupervisor(const RobotModel& model, const MotionOptions& options)
      : model_(&model), options_(&options), monitor_(options.lying_tilt) {}

  /** Activity of the motions in this step. */
  struct Activity {
    /** A motion runs or waits. */
    bool is_busy = false;
    /** The robot must stay on its feet: no motion runs that may leave them. */
    bool must_stay_upright = true;
    bool is_walking = false;
    /** Torso tilt at which the walk falls, rad. */
    double walking_tilt = kWalkingFallTilt;
  };

  /** Action that the core must take. */
  enum class Action { kNone, kProtect, kGetUp };

  /** Another robot, or the same one placed elsewhere, was taken over. */
  void reset() {
    needs_help_ = false;
    num_relapses_ = 0;
  }

  /** Before the first update(): notes whether the robot lies already. */
  void begin(const RobotState& state);

  /** The robot lies, and not because a motion put it there. */
  void note_fallen() { has_fallen_ = true; }

  /** One control step. @param dt  s since the last one.
   * @return kProtect: it falls, the fall motion must start now. kGetUp: a get-up motion must start.
   */
  Action update(const RobotState& state, const Activity& activity, double dt);

  /** Which motion has ended: the fall motion, a change of single joints that made none limp, or
   * another. */
  enum class Ended { kFall, kJointChange, kMotion };

  /** A motion has ended. A fallen robot whose head or arm was turned has fallen still.
   * @param is_done  False if it failed. */
  void note_end(bool is_done, Ended kind, const RobotState& state);

  /** Lies after a fall and has not got up yet. */
  bool has_fallen() const { return has_fallen_; }
  /** Falls in succession that each followed a get-up at once: that motion leaves the robot
   * unsteady. */
  int num_relapses() const { return num_relapses_; }
  /** Could not get up. */
  bool needs_help() const { return needs_help_; }

 private:
  /** @return Whether the robot falls in this step. */
  bool predict_fall(const RobotState& state, const Activity& activity, double dt);
  bool is_lying_now(const RobotState& state) const;
  void note_new_fall();

  const RobotModel* model_;
  const MotionOptions* options_;
  FallMonitor monitor_;
  bool has_fallen_ = false;
  /** Time for which it has lain still after a fall, without a motion, s. */
  double time_fallen_ = 0;
  /** The robot lay when no motion ran last, or when one was done: it lies on purpose, or the fall
   * is known. */
  bool was_lying_ = false;
  bool needs_help_ = false;
  /** Since the robot got up after a fall, s. */
  double time_since_up_ = std::numeric_limits<double>::infinity();
  int num_relapses_ = 0;
};

}  // namespace nao::motion
