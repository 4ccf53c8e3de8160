#pragma once

#include <memory>
#include <optional>

#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/walk_engine.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** A walk command is valid for this long, s. */
inline constexpr double kCommandLifetime = 0.5;

/** Why legs of this stiffness must not walk; nothing if they may.
 * @param stiffness  Stiffness of all motors, motor order. */
std::optional<Reason> find_soft_leg(const LegKinematics& legs,
                                    const std::vector<double>& stiffness);

/** Why a robot whose roll and pitch are doubtful must not walk; nothing if they are not. */
std::optional<Reason> find_orientation_doubt(const RobotState& state);

/** Why the robot must not start to walk; nothing if it may.
 * @param stiffness  Stiffness of all motors, motor order. */
std::optional<Reason> find_walk_obstacle(const LegKinematics& legs, const RobotState& state,
                                         const std::vector<double>& stiffness);

/** Height of the middle between the hips over the left sole, m. */
double calc_hip_height(const Kinematics& kinematics, const LegKinematics& legs);

/** Whether the walk can begin in the pose that these targets make: both soles flat on one level,
 * side by side, below bent knees. */
bool is_walking_stance(const RobotModel& model, const std::vector<double>& position);

/** Common parts of walk and move-to: the stand before, the engine, and the reasons to stop. */
class WalkingMotion : public MotionGenerator {
 public:
  /** @param gait       Must outlive this.
   * @param stand_up  Path to the posture in which a walk begins and ends; used if the robot does
   * not stand already. */
  WalkingMotion(const RobotModel& model, const Gait& gait,
                std::unique_ptr<MotionGenerator> stand_up);

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override;
  void finish() override;
  Mode mode() const override { return is_standing_up_ ? stand_up_->mode() : Mode::kWalking; }
  bool must_stay_upright() const override {
    return !is_standing_up_ || stand_up_->must_stay_upright();
  }
  Reason reason() const override { return reason_; }
  void describe(MotionState& state) const override;

 protected:
  /** start_steering() is called once, when the engine begins, and steer() in every tick before the
   * engine's; it commands a velocity or the end. */
  virtual void start_steering(const MotionContext& /*context*/) {}
  virtual void steer(const MotionContext& context) = 0;
  /** A walk command arrived while the walk was ending: the walk starts again. */
  virtual bool wants_to_go_on() const { return false; }
  /** Gives the reason to report when the walk has ended by itself. @return false if it failed. */
  virtual bool conclude(const MotionContext& /*context*/, Reason& /*reason*/) { return true; }

  WalkEngine& engine() { return engine_; }
  const WalkEngine& engine() const { return engine_; }

 private:
  std::optional<Reason> find_trouble(const MotionContext& context);

  WalkEngine engine_;
  std::unique_ptr<MotionGenerator> stand_up_;
  bool is_standing_up_ = false;
  bool is_finishing_ = false;
  bool has_ended_ = false;
  double time_in_air_ = 0;
  Reason reason_;
};

/** Walks at the velocity of the newest walk command, until that is zero or too old, or until
 * something else waits. */
class WalkMotion : public WalkingMotion {
 public:
  /** @param command  Nothing: the robot stands and was pushed; it steps at once, until it stands
   * again. */
  WalkMotion(const RobotModel& model, const Gait& gait, std::unique_ptr<MotionGenerator> stand_up,
             const std::optional<WalkCommand>& command);

  void start(const MotionContext& context, const JointTargets& targets) override;

  /** A walk's new velocity, or a kick to strike in passing. */
  bool adopt(const Command& command) override;
  std::optional<WalkCommand> gait_command() const override;
  Strike strike() const override;

 protected:
  void steer(const MotionContext& context) override;
  bool wants_to_go_on() const override;
  bool conclude(const MotionContext& context, Reason& reason) override;

 private:
  const RobotModel* model_;
  WalkCommand command_;
  bool answers_push_;
  /** Time since the command came, s. */
  double age_ = 0;
};

/** Walks to a pose and stops there, by odometry. */
class MoveToMotion : public WalkingMotion {
 public:
  MoveToMotion(const RobotModel& model, const Gait& gait, std::unique_ptr<MotionGenerator> stand_up,
               const MoveToCommand& command);

  double progress() const override { return progress_; }

 protected:
  void start_steering(const MotionContext& context) override;
  void steer(const MotionContext& context) override;
  bool conclude(const MotionContext& context, Reason& reason) override;

 private:
  /** Goal seen from where the robot would stand if it stopped now. */
  Pose2 remaining(const MotionContext& context) const;
  /** Body of a robot that stands on both feet, in odometry. */
  Pose2 standing_body(const RobotState& state) const;

  MoveToCommand command_;
  /** Goal of the body frame, which is between the feet. */
  Pose2 goal_in_odometry_;
  double turn_center_;
  WalkLimits limits_;
  double way_ = 0;
  double time_ = 0;
  double time_limit_ = 0;
  double progress_ = 0;
  bool is_there_ = false;
};

}  // namespace nao::motion
