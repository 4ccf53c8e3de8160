#include "daemons/motion/walk/feet.h"

#include <algorithm>

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

// Time constant with which a height that remains from an early or late touchdown decays, s.
// Chosen: below the duration of a step, so that errors of several steps do not add up.
constexpr double kHeightTimeConstant = 0.1;

// Pose of a sole in the support frame S: level, at a height, m.
Isometry3d level_pose(const Pose2& pose, double height) {
  Isometry3d result = Isometry3d::Identity();
  result.translation() << pose.position, height;
  result.linear() = AngleAxisd(pose.heading, Vector3d::UnitZ()).toRotationMatrix();
  return result;
}

}  // namespace

// The left foot supports first, so that S is the left sole; begin_starting() may exchange.
void Feet::start(const Pose2& right_in_left) {
  support_is_left_ = true;
  support_height_ = 0;
  support_spread_ = {};
  swing_.start(right_in_left, 0);
}

Isometry3d Feet::support_sole() const {
  return level_pose({}, support_height_);
}

Isometry3d Feet::swing_sole(const SwingOffset& offset) const {
  // A kick moves the sole beyond its trajectory, along the foot's own axes.
  Pose2 pose = swing_.pose();
  pose.position += pose.rotate(offset.reach);
  // The toe rises with the foot's forward velocity (rotation about -y), so that it does not touch
  // first.
  const double toe_up = gait_->swing.toe_pitch_gain * swing_.forward_velocity();
  return level_pose(pose, swing_.height() + offset.lift) * AngleAxisd(-toe_up, Vector3d::UnitY());
}

void Feet::level_support(double dt) {
  support_height_ -= std::min(1.0, dt / kHeightTimeConstant) * support_height_;
}

void Feet::level_both(double dt) {
  level_support(dt);
  swing_.lower(std::min(1.0, dt / kHeightTimeConstant) * swing_.height());
}

// The swing foot becomes the support foot. Returns the pose of the old support frame in the new
// one.
Pose2 Feet::exchange(const Spread& spread) {
  Pose2 to_new = swing_.pose().inverse();
  const double height = swing_.height();
  swing_.start(to_new, support_height_);
  // Heights are exchanged as well: a foot that touched early or late keeps its height, which
  // level_support() removes slowly.
  support_height_ = height;
  support_spread_ = spread;
  support_is_left_ = !support_is_left_;
  return to_new;
}

}  // namespace nao::motion
