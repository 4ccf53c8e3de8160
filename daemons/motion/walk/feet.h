#pragma once

#include <Eigen/Geometry>

#include "daemons/motion/walk/footstep_planner.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/swing_foot.h"
#include "daemons/motion/walk/walk_kick.h"
#include "kinematics/pose2.h"

namespace nao::motion {

/** Commanded poses of both feet in the support frame S: the ground under the support foot, with
 * origin and heading of its sole, z up. The other foot swings, or stands during double support. */
class Feet {
 public:
  explicit Feet(const Gait& gait) : gait_(&gait) {}

  /** Begins with both feet on the ground and the left one as support foot.
   * @param right_in_left  Right sole seen from the left one. */
  void start(const Pose2& right_in_left);

  bool support_is_left() const { return support_is_left_; }
  /** 1 if the left foot is the support foot, else -1. */
  double side() const { return support_is_left_ ? 1 : -1; }
  /** Spread with which the support foot was placed. */
  const Spread& support_spread() const { return support_spread_; }
  const SwingFoot& swing() const { return swing_; }
  SwingFoot& swing() { return swing_; }

  /** Nominal zero moment point of one foot, m, in the frame of its sole. */
  Eigen::Vector2d nominal_zmp(bool is_left) const {
    return {gait_->stance.zmp_forward, (is_left ? -1 : 1) * gait_->stance.zmp_inward};
  }
  /** Nominal zero moment points of the support foot and of the other foot, m, in S. */
  Eigen::Vector2d support_zmp() const { return nominal_zmp(support_is_left_); }
  Eigen::Vector2d other_zmp() const { return swing_.pose() * nominal_zmp(!support_is_left_); }
  /** Midpoint between these two, m, in S. */
  Eigen::Vector2d midpoint() const { return 0.5 * (support_zmp() + other_zmp()); }

  /** Soles in S. @param offset  Offset of a kick. */
  Eigen::Isometry3d support_sole() const;
  Eigen::Isometry3d swing_sole(const SwingOffset& offset) const;
  double support_height() const { return support_height_; }

  /** Lets the height at which a foot met the ground decay, because the ground is level. */
  void level_support(double dt);
  void level_both(double dt);

  /** The other foot becomes the support foot.
   * @param spread  Spread with which it was placed. @return The old frame S seen from the new one.
   */
  Pose2 exchange(const Spread& spread);

 private:
  const Gait* gait_;
  bool support_is_left_ = true;
  /** Commanded height of the support sole over level ground, m. */
  double support_height_ = 0;
  Spread support_spread_;
  SwingFoot swing_;
};

}  // namespace nao::motion
