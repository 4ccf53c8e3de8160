#pragma once

#include <limits>
#include <string>

#include "daemons/motion/joint_targets.h"
#include "daemons/motion/motion_options.h"
#include "daemons/motion/motion_state.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/sensors.h"
#include "kinematics/kinematics.h"
#include "messages/command.h"
#include "messages/mode.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** What a motion sees in one tick. The references hold for the call only. */
struct MotionContext {
  const RobotModel& model;
  const MotionOptions& options;
  /** This tick's measurements, the estimate made from them, and the kinematics of the measured
   * joint angles. */
  const Sensors& sensors;
  const RobotState& state;
  const Kinematics& kinematics;
  /** s since the last tick. */
  double dt;
};

/** One motion in progress: the way to a posture, a walk, a kick, getting up.
 *
 * The core calls start() once and step() in every tick until it returns something else than
 * kRunning. It may drop the motion between two ticks whenever can_be_replaced(); while that is
 * false and something newer waits it has called finish(), and goes on stepping until the motion
 * ends or lets itself be replaced. Whatever a motion writes, the core keeps the joints' limits and
 * speeds afterwards. */
class MotionGenerator {
 public:
  enum class Phase { kRunning, kDone, kFailed };

  virtual ~MotionGenerator() = default;

  /** Begins. @param targets  As sent in the last tick; a motion goes on from there, velocity too.
   */
  virtual void start(const MotionContext& context, const JointTargets& targets) = 0;

  /** One tick.
   * @param targets  In: as sent in the last tick. Out: position and stiffness to send in this one;
   *                 joints that the motion does not move stay as they are. `velocity` is the
   *                 core's: it follows from the positions. */
  virtual Phase step(const MotionContext& context, JointTargets& targets) = 0;

  /** Whether the motion may end right here, between two ticks. A walk in single support must not.
   */
  virtual bool can_be_replaced() const { return true; }

  /** Asks the motion to end at its next safe point, stable. May be called again and again. */
  virtual void finish() {}

  /** Goes on with a newer command of the same kind without ending (a walk's new velocity).
   * @return false if it must be a new motion. */
  virtual bool adopt(const Command& /*command*/) { return false; }

  /** What became of a kick that it adopted: a walk strikes in passing. */
  enum class Strike { kNone, kPending, kStruck, kMissed };
  virtual Strike strike() const { return Strike::kNone; }

  /** Mode while it runs. */
  virtual Mode mode() const = 0;

  /** Whether the robot shall be on its feet now: while this is true a fall is watched for. */
  virtual bool means_to_stand() const { return true; }

  /** Share done, 0..1; NaN where the end is open. */
  virtual double progress() const { return std::numeric_limits<double>::quiet_NaN(); }

  /** Why it failed after kFailed; a remark, usually none, after kDone. */
  virtual Reason reason() const { return {}; }

  /** Adds what a walk has to say: velocity after clipping, footsteps. */
  virtual void describe(MotionState& /*state*/) const {}
};

}  // namespace nao::motion
