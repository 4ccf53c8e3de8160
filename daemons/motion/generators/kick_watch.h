#pragma once

#include <optional>
#include <vector>

#include "daemons/motion/actions/kick_impact.h"
#include "daemons/motion/generators/motion_generator.h"
#include "kinematics/leg_kinematics.h"
#include "kinematics/pose2.h"

namespace nao::motion {

/** Judges whether a kick moved the ball: by where nao-vision saw the ball before the strike and
 * after it, else by how the ball slowed the foot (KickImpact). */
class KickWatch {
 public:
  /** @param impact  nullptr: the foot tells nothing. @param legs  Both must outlive this. */
  KickWatch(const KickImpact* impact, const LegKinematics& legs, bool is_left)
      : impact_(impact), legs_(&legs), is_left_(is_left) {}

  /** The ball that nao-vision knows now, seen from the middle between the soles, m; nothing if it
   * has not seen one for kFreshTime. */
  static std::optional<Eigen::Vector2d> find_ball(const MotionContext& context);

  /** Begins. @param strike_end  Time at which the strike ends, s since the start of the kick. */
  void start(const MotionContext& context, double strike_end);
  /** One control step. @param time  s since the start of the kick. */
  void step(const MotionContext& context, double time);

  struct Verdict {
    bool is_missed = false;
    /** Why it is missed; or a remark: direction, or that nobody saw. */
    Reason reason;
  };
  Verdict judge() const;

 private:
  /** Middle between the soles with the heading of the torso, odometry frame. */
  static Pose2 stance_of(const RobotState& state);

  const KickImpact* impact_;
  const LegKinematics* legs_;
  bool is_left_;
  double strike_end_ = 0;
  /** Robot time after which a sighting is one after the strike, microseconds; 0: not yet known. */
  int64_t struck_utime_ = 0;
  /** Heading of the kick in odometry, rad. */
  double heading_ = 0;
  /** In odometry, m. */
  std::optional<Eigen::Vector2d> before_;
  std::optional<Eigen::Vector2d> after_;
  std::vector<KickImpact::Sample> samples_;
};

}  // namespace nao::motion
