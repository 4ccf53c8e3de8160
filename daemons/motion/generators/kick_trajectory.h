#pragma once

#include <Eigen/Core>
#include <vector>

#include "daemons/motion/actions/kick.h"
#include "kinematics/pose2.h"

namespace nao::motion {

/** Reference of a kick at one moment, in frame S of KickMotion. */
struct KickReference {
  /** Center of mass over the ground, m. */
  Eigen::Vector2d com = Eigen::Vector2d::Zero();
  /** Origin of the kicking sole, m. */
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();
  /** Heading of the kicking sole, rad. */
  double foot_heading = 0;
  /** Pitch of the kicking sole, toes down, rad. */
  double foot_pitch = 0;
};

/** Fraction 0..1 to which the kicking foot moves independently of the ground: 0 while it stands,
 * 1 from the height on at which nothing of it can touch the ground. @param height  Height of the
 * sole, m.
 */
double airborne_fraction(double height);

/** Keeps the airborne foot on its path over the ground although the support foot slides or yaws.
 *
 * S moves with the support foot. A planned point p of S is at T p in the S of now, where
 * T = S_now^-1 S_start is planar with heading theta. With b = airborne_fraction(foot height):
 *     p' = p + b (T p - p),    heading' = heading + b theta.
 * The CoM's reference stays over the support foot.
 *
 * @param start_in_support  T: S at the start of the kick, in S as it is now. */
KickReference hold_path_over_ground(const KickReference& planned, const Pose2& start_in_support);

/** Planned CoM and kicking foot over time: minimum-jerk segments between the ends of the phases in
 * kick.yaml, mirrored for the right foot.
 *
 * The ball is to go along x of S: the airborne foot points along x and strikes along x. On the
 * ground it keeps the heading with which it stood. */
class KickTrajectory {
 public:
  /** @param ball  On the ground, seen from the middle between the soles, m; NaN: where the kick has
   *   it best. @param strength  0..1. */
  KickTrajectory(const Kick& kick, bool is_left, const Eigen::Vector2d& ball, double strength);

  /** Sets the stand that the kick begins and ends in. */
  void start_from(const KickReference& stand);

  /** Reference at a time since the start, s; the last phase's end after the end. */
  KickReference at(double time) const;
  /** Reference when the foot touches the ball, or at the end of the strike if that comes first. */
  const KickReference& impact() const { return impact_; }
  /** s. */
  double duration() const { return duration_; }
  /** Time at which the strike ends, s since the start. */
  double strike_end() const;

 private:
  struct Segment {
    double duration;
    KickReference end;
    bool is_strike;
  };

  void find_impact();

  std::vector<Segment> segments_;
  double duration_ = 0;
  /** Position of the ball ahead of the middle between the soles, m. */
  double ball_x_;
  /** Distance of the ball's center ahead of the sole's origin when they touch, m. */
  double ball_contact_;
  KickReference stand_;
  KickReference impact_;
};

}  // namespace nao::motion
