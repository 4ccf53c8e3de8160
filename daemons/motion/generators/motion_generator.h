#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "daemons/motion/joint_targets.h"
#include "daemons/motion/motion_options.h"
#include "daemons/motion/motion_state.h"
#include "daemons/motion/policy_record.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/seen_ball.h"
#include "daemons/motion/sensors.h"
#include "kinematics/kinematics.h"
#include "messages/command.h"
#include "messages/mode.h"
#include "messages/reason.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Input of a motion in one control step. The references are valid during the call only. */
struct MotionContext {
  const RobotModel& model;
  const MotionOptions& options;
  /** Measurements of this step, the state estimated from them, and the kinematics of the measured
   * joint angles. */
  const Sensors& sensors;
  const RobotState& state;
  const Kinematics& kinematics;
  /** Time since the last step, s. */
  double dt;
  /** nullptr while nao-vision knows none. */
  const SeenBall* ball = nullptr;
};

/** One motion in progress: to a posture, a walk, a kick, a get-up motion.
 *
 * The core calls start() once and then step() in every control step until it returns something
 * other than kRunning. Between two steps it may drop the motion if can_be_replaced(). If a newer
 * motion waits and can_be_replaced() is false, the core calls finish() and continues to step until
 * the motion ends or can be replaced. The core limits the joint targets of every motion afterwards.
 */
class MotionGenerator {
 public:
  enum class Phase { kRunning, kDone, kFailed };

  virtual ~MotionGenerator() = default;

  /** Starts the motion. @param targets  As sent in the last step; the motion continues from their
   * position and velocity. */
  virtual void start(const MotionContext& context, const JointTargets& targets) = 0;

  /** One control step.
   * @param targets  In: as sent in the last step. Out: position and stiffness to send in this one;
   *                 joints that the motion does not move keep theirs. The core derives `velocity`
   *                 from the positions. */
  virtual Phase step(const MotionContext& context, JointTargets& targets) = 0;

  /** Whether the motion may end here, between two steps. False for a walk in single support. */
  virtual bool can_be_replaced() const { return true; }

  /** Asks the motion to end at its next safe point. May be called repeatedly. */
  virtual void finish() {}

  /** Continues with a newer command of the same kind without ending (a walk's new velocity).
   * @return false if the command needs a motion of its own. */
  virtual bool adopt(const Command& /*command*/) { return false; }

  /** A motor's stiffness on its way to a new value. */
  struct StiffnessRamp {
    int motor;
    double goal;
    /** Time until the goal is reached, s. */
    double time_left;
  };

  /** Ramps that would be left unfinished if the motion ended now; for a motion that has not begun,
   * all its ramps. */
  virtual std::vector<StiffnessRamp> unfinished_ramps(const RobotModel& /*model*/) const {
    return {};
  }

  /** Called before start(), once for each motion that this one replaces, the newest first: what
   * they began is continued for joints whose stiffness this motion leaves alone. */
  virtual void continue_ramps(const std::vector<StiffnessRamp>& /*ramps*/) {}

  /** Command of a walk by the gait, which a policy may go on with; nothing: it is none. */
  virtual std::optional<WalkCommand> gait_command() const { return std::nullopt; }

  /** Progress of a kick that this motion adopted: a walk kicks without stopping. */
  enum class Strike { kNone, kPending, kStruck, kMissed };
  virtual Strike strike() const { return Strike::kNone; }

  /** Mode while it runs. */
  virtual Mode mode() const = 0;

  /** Whether the robot must stay on its feet now: falls are predicted while this is true. */
  virtual bool must_stay_upright() const { return true; }

  /** Torso tilt from which on a walk does not recover, rad; nothing: kWalkingFallTilt. */
  virtual std::optional<double> fall_tilt() const { return std::nullopt; }

  /** Fraction done, 0..1; NaN if the end is open. */
  virtual double progress() const { return std::numeric_limits<double>::quiet_NaN(); }

  /** Why it failed after kFailed; a remark, usually none, after kDone. */
  virtual Reason reason() const { return {}; }

  /** The robot falls, and the motion ends. @return Why it failed. */
  virtual Reason note_fall() { return {"robot-fell"}; }

  /** Step that a policy made in this control step; nullptr without one. */
  virtual const PolicyRecord* policy_record() const { return nullptr; }

  /** Adds what only this motion knows: a walk's velocity after clipping, its footsteps. */
  virtual void describe(MotionState& /*state*/) const {}
};

}  // namespace nao::motion
