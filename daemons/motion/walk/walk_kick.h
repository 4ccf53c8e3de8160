#pragma once

#include <Eigen/Core>
#include <optional>

#include "daemons/motion/walk/gait.h"
#include "kinematics/pose2.h"

namespace nao::motion {

/** Displacement of the swing foot from its trajectory: m, in the foot's frame, and m up. */
struct SwingOffset {
  Eigen::Vector2d reach = Eigen::Vector2d::Zero();
  double lift = 0;
};

/** A kick during the walk: steers the steps before it to the ball, chooses the step that kicks, and
 * adds the kick to that step's swing. */
class WalkKick {
 public:
  enum class State { kNone, kPending, kStruck, kMissed };

  explicit WalkKick(const Gait& gait) : gait_(&gait) {}

  /** Forgets any kick. */
  void reset();

  /** Asks for a kick.
   * @param ball  In odometry, m: the steps lead to it. If none, the next complete swing of the foot
   * kicks wherever it passes. */
  void request(bool with_left, const std::optional<Eigen::Vector2d>& ball);

  void advance(double dt) { time_ += dt; }

  /** Plans the step that begins.
   * @param commanded  m/s, m/s, rad/s. @param body  In odometry.
   * @return Velocity for this step: the commanded one, or the one that leads to the ball. */
  Eigen::Vector3d begin_step(const Eigen::Vector3d& commanded, bool support_is_left,
                             const Pose2& body);
  /** The swing foot has landed. */
  void end_step();

  /** State of the last requested kick. */
  State state() const { return state_; }
  /** The current step kicks. */
  bool is_striking() const { return is_striking_; }
  /** The steps lead to a ball. */
  bool seeks_ball() const { return state_ == State::kPending && ball_; }
  /** Offset of the swing foot in the current step. @param phase  Elapsed fraction of the step. */
  SwingOffset swing_offset(double phase) const;

 private:
  Eigen::Vector3d approach_ball(const Eigen::Vector3d& commanded, bool kicks_next,
                                const Pose2& body);
  void begin_strike(const Eigen::Vector2d& ball_offset);

  const Gait* gait_;
  State state_ = State::kNone;
  bool with_left_ = false;
  /** Ball in odometry, m. */
  std::optional<Eigen::Vector2d> ball_;
  /** Time since the request, s. */
  double time_ = 0;
  bool is_striking_ = false;
  /** Vector from the best place of the ball to the ball, m, in the body frame. */
  Eigen::Vector2d ball_offset_ = Eigen::Vector2d::Zero();
};

}  // namespace nao::motion
