#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "daemons/motion/joint_targets.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/walk/com_reference.h"
#include "daemons/motion/walk/feet.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/lag_estimator.h"
#include "daemons/motion/walk/step_planner.h"
#include "daemons/motion/walk/velocity_planner.h"
#include "daemons/motion/walk/walk_kick.h"
#include "daemons/motion/walk/walk_observer.h"
#include "daemons/motion/walk/whole_body_controller.h"
#include "kinematics/kinematics.h"
#include "kinematics/pose2.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Omnidirectional walk from a stand to a stand: the state machine of the gait.
 *
 * It owns stages and step timing, and passes in each tick: measurements (WalkObserver) to the
 * reference of the center of mass (ComReference); velocity (VelocityPlanner, WalkKick) to footsteps
 * and DCM (StepPlanner); the DCM to zero moment point (zmp_control.h), step duration
 * (step_timing.h) and foothold; all of that to joint targets (WholeBodyController). README.md has
 * the equations.
 *
 * The support frame S is the ground under the support foot: origin and heading of its sole, z up.
 *
 * No clock, bus or log; equal inputs give equal outputs.
 *
 * It has more than 25 methods since each stage of the gait has a beginning and a step of its own,
 * and all of them share the state of the gait. */
class WalkEngine {
 public:
  enum class Stage {
    /** Double support: the torso moves to its walking height. */
    kLowering,
    /** Double support: the weight moves to the first support foot. */
    kStarting,
    kStepping,
    /** Double support, feet side by side: the center of mass comes to rest between them. */
    kStopping,
    /** At rest: the joints move to the end posture. */
    kRaising,
    kDone,
  };

  /** @param model, gait  Must outlive this. @param end_posture  Standing posture after the walk. */
  WalkEngine(const RobotModel& model, const Gait& gait, const Posture& end_posture);
  /** Not copied: its parts refer to one another. */
  WalkEngine(const WalkEngine&) = delete;
  WalkEngine& operator=(const WalkEngine&) = delete;

  /** Begins with both feet on the ground. @param targets  As sent in the last tick. */
  void start(const JointTargets& targets);

  /** Begins with a step at once, in a stand from which the robot was pushed; the walk ends as soon
   * as it stands. @param dt  Control period, s. */
  void start_pushed(const RobotState& state, const Kinematics& measured, double dt,
                    const JointTargets& targets);

  /** @param velocity  Commanded: m/s ahead and to the left, rad/s. Takes effect at the next step,
   * clipped to the robot's limits. Zero: steps in place. */
  void set_velocity(const Eigen::Vector3d& velocity) { commanded_ = velocity; }
  /** Ends the walk at the next double support that allows it. */
  void end() { is_ending_ = true; }
  /** Withdraws end(), while the robot still steps. */
  void resume() { is_ending_ = false; }
  /** Kick during the walk. */
  WalkKick& kick() { return kick_; }
  const WalkKick& kick() const { return kick_; }

  /** One control tick.
   * @param measured  Kinematics of the measured joint angles.
   * @param dt        Time by which the walk advances, s.
   * @param targets   Out: positions of legs and arms. @return false when the walk has ended. */
  bool step(const RobotState& state, const Kinematics& measured, double dt, JointTargets& targets);

  Stage stage() const { return stage_; }
  const LegKinematics& legs() const { return body_.pose().legs(); }
  /** Velocity of the current step after clipping: m/s, m/s, rad/s. */
  const Eigen::Vector3d& velocity() const { return velocity_.velocity(); }
  /** The next footstep first; soles in odometry. */
  std::vector<PlannedStep> footsteps_in_odometry() const;
  /** Body frame that the support foot was placed beside, in odometry: where the robot stands if it
   * stops now. */
  Pose2 body_in_odometry() const;
  /** Midpoint of the soles, with the torso's heading, in odometry. */
  Pose2 midpoint_in_odometry() const { return observer_.midpoint_in_odometry(); }

 private:
  void step_lowering();
  void begin_starting();
  void step_starting(double dt);
  void begin_step();
  void exchange_support() { reference_.change_frame(feet_.exchange(feet_.support_spread())); }
  /** Turns the present step into the one that brings the center of mass to rest. */
  void begin_capture();
  void step_stepping(double dt);
  /** Step duration, ZMP and foothold from the DCM. */
  void control_dcm();
  void move_swing_foot(double dt);
  bool has_landed(double dt);
  void change_support();
  void step_stopping(double dt);
  void begin_raising();
  /** Plans from the current step on. */
  void plan_steps() {
    steps_.plan(feet_, reference_, velocity_.step_velocity(), is_ending_, duration_ - time_);
  }
  BodyCommand body_command() const;

  const Gait* gait_;
  double weight_;
  Stage stage_ = Stage::kDone;
  /** Elapsed in the present stage or step, and its duration, s. */
  double time_ = 0;
  double duration_ = 0;

  Eigen::Vector3d commanded_ = Eigen::Vector3d::Zero();
  bool is_ending_ = false;
  /** The robot recovers from a push: its steps are as short as they can be. */
  bool is_pushed_ = false;
  /** The present step was planned to end the walk. */
  bool is_capturing_ = false;

  VelocityPlanner velocity_;
  WalkKick kick_;
  StepPlanner steps_;
  Feet feet_;
  ComReference reference_;
  LagEstimator lag_;
  WalkObserver observer_;
  WholeBodyController body_;
  /** Fraction of the weight that is planned on the foot that is not the support foot, 0..1. */
  double other_load_ratio_ = 0;
  /** Fraction of the transition from the posture before or after the walk (0) to the walk (1). */
  double walk_fraction_ = 0;
};

}  // namespace nao::motion
