#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/actions/kick.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/servo_feedforward.h"
#include "kinematics/leg_kinematics.h"

namespace nao::motion {

/** Kicks from a stand: the CoM moves over the support foot, the other foot strikes, and both come
 * back. Balance by the centre of mass, the standing ankle's torque and the gyroscope.
 *
 * Frame S is the standing sole, levelled, as the joints have it. For a kick with the right foot the
 * data's y is mirrored. */
class KickMotion : public MotionGenerator {
 public:
  /** @param kick, gait    Must outlive this; of the gait the balance at the ankles is taken.
   * @param stand_up      Way to the stand that a kick begins in, taken if the robot does not stand.
   * @param ball          On the ground, seen from the middle between the soles, m; NaN: where the
   *                      kick has it best. @param strength  0..1; NaN: as the kick says. */
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
  /** What the body does at a moment, in S. */
  struct Reference {
    Eigen::Vector2d mass = Eigen::Vector2d::Zero();
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();
    double pitch = 0;
  };

  void start_kick(const JointTargets& targets);
  Reference reference_at(double time) const;
  std::vector<double> solve(const Reference& reference, const Eigen::Isometry3d& torso,
                            const std::vector<double>& position) const;
  Eigen::Isometry3d torso_for(const Reference& reference) const;
  void follow(const MotionContext& context, const Reference& reference, JointTargets& targets);
  double side() const { return is_left_ ? 1 : -1; }

  const RobotModel* model_;
  const Kick* kick_;
  const Gait* gait_;
  std::unique_ptr<MotionGenerator> stand_up_;
  bool is_standing_up_ = false;
  bool is_finishing_ = false;
  bool is_left_;
  double strength_;
  LegKinematics legs_;
  ServoFeedforward feedforward_;
  Kinematics kinematics_;

  std::vector<Kick::Phase> phases_;
  double duration_ = 0;
  double time_ = 0;
  Reference start_reference_;
  /** Torso in S at the start: its height and orientation are kept. */
  Eigen::Isometry3d start_torso_ = Eigen::Isometry3d::Identity();
  double kick_heading_ = 0;
  std::vector<double> reference_position_;
  Eigen::Vector3d com_in_torso_ = Eigen::Vector3d::Zero();
  double height_ = 0.26;
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  Reason reason_;
};

}  // namespace nao::motion
