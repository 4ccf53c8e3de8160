#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "daemons/motion/joint_targets.h"
#include "daemons/motion/walk/com_reference.h"
#include "daemons/motion/walk/feet.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/servo_feedforward.h"
#include "daemons/motion/walk/walk_observer.h"
#include "daemons/motion/walk/walk_pose.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Commands of the walk to the body in one tick. The references hold for the call only. */
struct BodyCommand {
  /** Transition between the walk and the postures before and after it. */
  enum class Transition { kFromStart, kNone, kToEnd };

  const ComReference& reference;
  const Feet& feet;
  /** Offset of the swing foot by a kick. */
  SwingOffset swing_offset;
  /** Fraction of the weight on the foot that is not the support foot, 0..1. */
  double other_load_ratio;
  bool is_double_support;
  Transition transition;
  /** Fraction of the transition from the posture before or after the walk (0) to the walk (1). */
  double walk_fraction;
};

/** Computes joint targets: inverse kinematics of the commanded pose, plus feedforward for load and
 * velocity, plus feedback of the torso's orientation. */
class WholeBodyController {
 public:
  /** @param end_posture  Posture in which the walk ends. */
  WholeBodyController(const RobotModel& model, const Gait& gait, const Posture& end_posture);

  const WalkPose& pose() const { return pose_; }
  /** Commanded angles without feedforward and feedback, rad, (num_motors). */
  const std::vector<double>& position() const { return position_; }

  /** Reads the pose that the walk begins in. @param position  As sent in the last tick, rad,
   * (num_motors). */
  void read_start(const std::vector<double>& position);

  /** Begins. The difference between the targets of read_start() and the angles of the commanded
   * pose (load, feet that are not level) stays in the targets and fades with the transition. */
  void start(const BodyCommand& command);

  /** One tick. @param targets  Out: positions of legs and arms. */
  void step(const BodyCommand& command, const WalkObserver& measured, double dt,
            JointTargets& targets);

 private:
  /** Moves the commanded pose. */
  void update_pose(const BodyCommand& command, double dt);
  std::vector<double> calc_torques(const BodyCommand& command, const WalkObserver& measured) const;

  const Gait* gait_;
  double mass_;
  const Posture* end_posture_;
  WalkPose pose_;
  ServoFeedforward feedforward_;
  /** Angles and velocities of the commanded pose, rad, rad/s, (num_motors): without offsets. */
  std::vector<double> position_;
  std::vector<double> velocity_;
  /** rad/s^2. */
  std::vector<double> acceleration_;
  /** rad, (num_motors). */
  std::vector<double> start_offset_;
};

}  // namespace nao::motion
