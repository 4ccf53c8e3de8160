#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "daemons/motion/joint_targets.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/walk/footstep_planner.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/path_keeper.h"
#include "daemons/motion/walk/pendulum.h"
#include "daemons/motion/walk/pendulum_estimator.h"
#include "daemons/motion/walk/servo_feedforward.h"
#include "daemons/motion/walk/swing_foot.h"
#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"
#include "kinematics/pose2.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Walks: from a stand, at any velocity that the gait holds, to a stand.
 *
 * Frame S is the ground under the standing foot: origin and heading of its sole, z up. In S the
 * engine carries a reference of the centre of mass on the pendulum's law; footprints are planned
 * from the wished velocity, and where the divergent component must be when the next foot lands
 * follows from them backwards. In every tick the reference gives way a little to what was measured,
 * the zero moment point steers within the sole, and what it cannot mend moves the next footprint
 * and the time when the foot lands. Joint targets are inverse kinematics plus what the servos need
 * to follow, plus damping from the gyroscope.
 *
 * No clock, bus or log; the same inputs give the same outputs. */
class WalkEngine {
 public:
  /** What the engine is about. */
  enum class Stage {
    /** Both feet stand: the torso goes to its walking height. */
    kLowering,
    /** Both feet stand: the mass is pushed towards the foot that will stand first. */
    kStarting,
    kStepping,
    /** Both feet stand side by side: the mass comes to rest between them. */
    kStopping,
    /** At rest; joints go to the posture to end in. */
    kRaising,
    kDone,
  };

  /** @param model, gait  Must outlive this. @param end_posture  To stand in afterwards. */
  WalkEngine(const RobotModel& model, const Gait& gait, const Posture& end_posture);

  /** Begins with both feet on the ground. @param targets  As sent in the last tick. */
  void start(const JointTargets& targets);

  /** @param velocity  Wished: m/s ahead and to the left, rad/s. Takes effect at the next step,
   * clipped to what the gait holds. All zero: walks on the spot. */
  void set_velocity(const Eigen::Vector3d& velocity) { wished_ = velocity; }
  /** Comes to a stand at the next double support that allows it. */
  void end() { is_ending_ = true; }
  /** Wants to walk on after end(), as long as it is still stepping. */
  void resume() { is_ending_ = false; }

  /** Strikes with a foot in passing, and walks on.
   * @param ball  In odometry, m: the steps until then lead to where the foot hits it. Nothing: the
   * foot's next swing that is whole strikes, wherever it passes. */
  void kick(bool with_left, const std::optional<Eigen::Vector2d>& ball);
  /** What became of the last kick wished for. */
  enum class KickState { kNone, kPending, kStruck, kMissed };
  KickState kick_state() const { return kick_state_; }
  /** The point between the feet, and where the torso looks, in odometry: where a ball is seen from.
   */
  Pose2 middle_in_odometry() const;

  /** One tick. @param measured  Kinematics of the measured angles.
   * @param targets  Out: position of legs and arms. @return false when done. */
  bool step(const RobotState& state, const Kinematics& measured, double dt, JointTargets& targets);

  const LegKinematics& legs() const { return legs_; }
  Stage stage() const { return stage_; }
  bool has_both_feet_down() const { return stage_ != Stage::kStepping; }
  /** Being carried out, after clipping. */
  const Eigen::Vector3d& velocity() const { return velocity_; }
  /** Next one first, in the frame of S. */
  const std::vector<PlannedStep>& planned_steps() const { return planned_; }
  bool support_is_left() const { return support_is_left_; }
  /** The body that the standing foot was set down beside, in odometry: where it stands if the walk
   * ends now. */
  Pose2 body_in_odometry() const;
  /** The body of a robot that stands on both feet. */
  Pose2 standing_body(const RobotState& state) const;
  /** S in odometry, as of the last step(). */
  const Pose2& support_in_odometry() const { return support_in_odometry_; }

  /** For plots: reference and estimate of the mass in S, zero moment point aimed at. */
  const PendulumState& reference() const { return reference_; }
  const PendulumState& estimate() const { return estimator_.state(); }
  const Eigen::Vector2d& zero_moment_point() const { return zmp_; }
  double omega() const { return omega_; }
  double time_in_step() const { return time_; }
  double step_duration() const { return duration_; }

 private:
  /** A joint that the walk holds beside the legs. */
  struct ArmJoint {
    int motor;
    /** rad, and rad per m of stride. */
    double angle;
    double swing;
  };

  void measure(const RobotState& state, const Kinematics& measured, double dt);
  void step_lowering();
  void begin_starting();
  void step_starting(double dt);
  void begin_step();
  /** Turns the running step into the one that brings the mass to rest. */
  void begin_capture();
  void step_stepping(double dt);
  void adapt_duration();
  /** The other foot becomes the one that stands; everything is re-expressed in its frame. */
  void exchange_feet();
  void change_support();
  void step_stopping(double dt);
  void begin_raising();
  void step_raising();

  /** What is wished of the step that begins: the walk's velocity, the way to a ball, or the end. */
  Eigen::Vector3d choose_velocity();
  /** Leads to the ball, or makes the step that begins strike it. @return Velocity to walk at. */
  Eigen::Vector3d approach_ball(const Eigen::Vector3d& wished);
  void begin_kick(const Eigen::Vector2d& off);
  /** The velocity, and what brings the body back to its path. */
  Eigen::Vector3d calc_step_velocity();
  /** The steps that follow; at the end of a walk those that lead to rest: one, if that can end
   * beside the standing foot, else two. */
  void plan_steps();
  void plan_ahead(int num_steps);
  /** Where the zero moment point shall be to end the step well, within its reach, m, in S. */
  Eigen::Vector2d steer_zmp(double remaining) const;
  /** The step under way, as it was planned, will end with the feet side by side. */
  bool can_end_square() const;
  void give_way(double dt);
  Eigen::Vector2d& bias() { return bias_[support_is_left_ ? 0 : 1]; }
  void share_by_pressure();
  Eigen::Isometry3d torso_in_support() const;
  /** Swinging sole in S, with what a kick adds. */
  Eigen::Isometry3d swing_in_support() const;
  /** Angles of all motors for the present reference and feet; all but legs and arms as before. */
  std::vector<double> pose_joints();
  void follow_reference(double dt, JointTargets& targets);
  std::array<FootLoad, 2> plan_loads(const Eigen::Isometry3d& torso) const;
  void add_balance(std::vector<double>& offset) const;

  /** 1 if the left foot stands, else -1. */
  double side() const { return support_is_left_ ? 1 : -1; }
  /** Where the weight acts on a sole by itself, m, in the sole's frame. */
  Eigen::Vector2d nominal_zmp(bool is_left) const {
    return {gait_->zmp_forward, (is_left ? -1 : 1) * gait_->zmp_inward};
  }
  /** Between the two feet, m, in S. */
  Eigen::Vector2d middle() const;
  /** Where the mass rests when the walk has ended, m, in S: from there the stand is reached without
   * the mass moving. */
  Eigen::Vector2d rest() const { return middle() + Eigen::Vector2d(stand_lead_, 0); }

  const RobotModel* model_;
  const Gait* gait_;
  const Posture* end_posture_;
  LegKinematics legs_;
  FootstepPlanner planner_;
  ServoFeedforward feedforward_;
  PendulumEstimator estimator_;
  Kinematics reference_kinematics_;

  Stage stage_ = Stage::kDone;
  Eigen::Vector3d wished_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  /** With what keeps the body on its path. */
  Eigen::Vector3d step_velocity_ = Eigen::Vector3d::Zero();
  PathKeeper path_;
  bool is_ending_ = false;
  /** The running step was planned to end the walk. */
  bool is_capturing_ = false;
  /** Steps begun since the end was wished for. */
  int num_ending_steps_ = 0;
  KickState kick_state_ = KickState::kNone;
  bool kicks_with_left_ = false;
  /** In odometry, m. */
  std::optional<Eigen::Vector2d> ball_;
  /** s since the kick was wished for. */
  double kick_time_ = 0;
  /** The running step strikes; how far off the kick's best place the ball lies, m, in the body's
   * frame. */
  bool is_kick_step_ = false;
  Eigen::Vector2d kick_offset_ = Eigen::Vector2d::Zero();

  /** s in the present stage or step, and how long that takes. */
  double time_ = 0;
  double duration_ = 0;
  double omega_ = 6;
  double height_ = 0.26;

  bool support_is_left_ = true;
  /** Of the standing sole over level ground, m, as the targets have it; fades. */
  double support_height_ = 0;
  Spread support_spread_;
  SwingFoot swing_;
  std::vector<PlannedStep> planned_;
  /** Where the swinging foot is to land, adapted. */
  Pose2 foothold_;
  /** Where the divergent component shall be at the end and at the start of this step, m, in S. */
  Eigen::Vector2d divergent_goal_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d divergent_start_ = Eigen::Vector2d::Zero();

  /** How far, in the steps on the left and on the right foot, the divergent component ends beyond
   * where the pendulum says, m: learnt, slowly. */
  std::array<Eigen::Vector2d, 2> bias_ = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  Eigen::Vector2d deviation_ = Eigen::Vector2d::Zero();

  PendulumState reference_;
  Eigen::Vector2d zmp_ = Eigen::Vector2d::Zero();
  /** Share of the weight that is planned on the foot that does not stand, 0..1. */
  double other_share_ = 0;

  /** Measurements: the mass when this tick's targets will take effect; tilt of the torso against
   * the wished one, rad (roll, pitch), its rate, rad/s; force on the swinging foot, N. */
  PendulumState predicted_;
  bool has_estimate_ = false;
  bool has_changed_support_ = false;
  double last_support_heading_ = 0;
  double torso_heading_ = 0;
  Pose2 support_in_odometry_;
  /** Left, right. */
  std::array<Pose2, 2> soles_in_odometry_;
  Eigen::Vector3d tilt_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  double swing_force_ = 0;

  /** Lowering: torso in S at the start, share of the way done, and what the targets were beyond the
   * angles of that pose. */
  Eigen::Isometry3d start_torso_ = Eigen::Isometry3d::Identity();
  double share_ = 0;
  std::vector<double> start_position_;
  std::vector<double> start_offset_;

  /** Without the servos' offsets. */
  std::vector<double> wished_position_;
  std::vector<double> wished_velocity_;
  double wished_pitch_ = 0;
  Eigen::Vector3d mass_centre_in_torso_ = Eigen::Vector3d::Zero();
  std::vector<ArmJoint> arms_;
  /** How much farther ahead the mass is in the end posture than between loaded feet, m. */
  double stand_lead_ = 0;
};

}  // namespace nao::motion
