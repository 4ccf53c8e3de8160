#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "daemons/motion/actions/kick.h"
#include "daemons/motion/estimator/gyroscope_filter.h"
#include "daemons/motion/generators/kick_pose.h"
#include "daemons/motion/generators/kick_trajectory.h"
#include "daemons/motion/generators/kick_watch.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/servo_feedforward.h"
#include "kinematics/pose2.h"

namespace nao::motion {

/** Kicks from a stand: the CoM moves over the support foot, the other foot strikes, and both come
 * back. Balance by the ZMP under the support foot and by the gyroscope at its ankle.
 *
 * Frame S: origin at the support sole, z up; x is the torso's heading at the start, and that is the
 * direction in which the ball is to go. S slides and yaws with the support sole; the foot's path is
 * corrected for that (hold_path_over_ground()), and the torso turns such that the foot points along
 * its path (KickPose). */
class KickMotion : public MotionGenerator {
 public:
  /** @param kick, gait    Must outlive this; the kick uses the gait's gains at the ankles.
   * @param stand_up      Motion to the stand that a kick begins in, used if the robot does not
   *                      stand.
   * @param ball          On the ground, seen from the middle between the soles, m; NaN: where
   *                      nao-vision sees it within the kick's reach, else where the kick has it
   * best. @param strength  0..1; NaN: as the kick says. */
  KickMotion(const RobotModel& model, const Kick& kick, const Gait& gait,
             std::unique_ptr<MotionGenerator> stand_up, bool is_left, const Eigen::Vector2d& ball,
             double strength);

  /** Why a ball cannot be kicked; nothing if it can. NaN counts as well placed. */
  static std::optional<Reason> find_obstacle(const Kick& kick, bool is_left,
                                             const Eigen::Vector2d& ball);

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override;
  void finish() override;
  Mode mode() const override { return Mode::kActing; }
  double progress() const override;
  Reason reason() const override { return reason_; }

 private:
  /** Where the foot must meet the ball: as commanded, else as seen. */
  Eigen::Vector2d choose_ball(const MotionContext& context) const;
  void start_kick(const MotionContext& context, const JointTargets& targets);
  /** S in the odometry frame. */
  Pose2 support_in_odometry(const RobotState& state) const;
  void follow(const MotionContext& context, const KickReference& planned, JointTargets& targets);
  /** Vector from the reference of the CoM to the ZMP that corrects the measured DCM, m, in S.
   * @param com_velocity  Velocity of the reference, m/s. */
  Eigen::Vector2d calc_zmp_offset(const RobotState& state, const KickReference& reference,
                                  const Eigen::Vector2d& com_velocity) const;
  /** Forces of the ground on the left and the right foot, in the torso frame. */
  std::array<FootLoad, 2> calc_loads(const KickReference& reference, const Eigen::Isometry3d& torso,
                                     const Eigen::Vector2d& zmp_offset) const;
  /** @param torque, velocity  Torques and velocities of all motors, N m and rad/s: what the servos'
   * offsets are for. */
  void write_targets(const std::vector<double>& torque, const std::vector<double>& velocity,
                     JointTargets& targets) const;

  const RobotModel* model_;
  const Kick* kick_;
  const Gait* gait_;
  std::unique_ptr<MotionGenerator> stand_up_;
  bool is_standing_up_ = false;
  bool is_finishing_ = false;
  bool is_left_;
  Eigen::Vector2d ball_;
  /** 0..1. */
  double strength_;
  KickTrajectory trajectory_;
  KickPose pose_;
  ServoFeedforward feedforward_;
  Kinematics kinematics_;
  KickWatch watch_;

  /** Time since the start of the kick, s. */
  double time_ = 0;
  /** Reference of the CoM in the step before, m. */
  Eigen::Vector2d last_planned_com_ = Eigen::Vector2d::Zero();
  /** S at the start. */
  Pose2 start_in_odometry_;
  /** Positions of all motors, rad, without what balance and feedforward add. */
  std::vector<double> reference_position_;
  GyroscopeFilter gyroscope_;
  Reason reason_;
};

}  // namespace nao::motion
