#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao::motion {

/** Least duration of a stage relative to the distance over the maximum speed. Chosen: a spline that
 * starts and ends at rest peaks at 1.5 times its mean velocity; between 1.15 and 1.5 TargetLimiter
 * clips that peak, and the targets catch up towards the end of the stage. */
inline constexpr double kMinDurationRatio = 1.15;

/** One keyframe of a motion that is kept as data. */
struct Keyframe {
  /** Time from the previous keyframe to this one at full speed, s. */
  double duration = 0;
  /** Targets at its end, rad, (num_motors); NaN: as in the previous keyframe. */
  std::vector<double> position;
  /** Fraction of the peak torque from its start on, (num_motors); NaN: as in the previous keyframe.
   */
  std::vector<double> stiffness;
  /** Time for which the targets rest afterwards, at any speed, s. The pause of a transition's last
   * keyframe ends early, as soon as the body is in the state to which the transition leads. */
  double pause = 0;
  /** Gain of AnkleDamping until its end, s. */
  double ankle_damping = 0;
  /** Allowed range of a component of the direction of up. */
  struct Range {
    double least = -std::numeric_limits<double>::infinity();
    double greatest = std::numeric_limits<double>::infinity();
    bool has(double value) const { return value >= least && value <= greatest; }
  };
  /** Ranges of the x, y and z components of the up direction in the torso frame at the end; outside
   * them the motion has failed. */
  Range up[3];
  /** Whether a direction of up, in the torso frame, is in all three. */
  bool has_up(const Eigen::Vector3d& direction) const {
    return up[0].has(direction.x()) && up[1].has(direction.y()) && up[2].has(direction.z());
  }
};

/** A motion that is kept as data: keyframes that lead from one state of the body to another. */
struct KeyframeSequence {
  std::string name;
  /** States of the body (find_body_state()), or a posture's name. */
  std::string from;
  std::string to;
  std::vector<Keyframe> keyframes;

  /** s at full speed. */
  double duration() const;
};

/** The motion with left and right exchanged. */
KeyframeSequence mirrored(const RobotModel& model, const KeyframeSequence& sequence);

/** Angles of a posture with left and right exchanged, rad, (num_motors). */
std::vector<double> mirrored(const RobotModel& model, const std::vector<double>& position);

/** Interpolates joint targets through the keyframes of a sequence, from the present targets.
 *
 * Cubic Hermite splines. A joint that continues in the same direction between two keyframes without
 * a pause does not stop there: its velocity is the harmonic mean of the slopes on both sides, which
 * keeps the spline monotone, so that it never overshoots a keyframe. In every other keyframe it is
 * 0.
 *
 * Source: F. N. Fritsch, R. E. Carlson, "Monotone piecewise cubic interpolation", SIAM J. Numer.
 * Anal. 17(2), 1980; the harmonic mean is from F. N. Fritsch, J. Butland, SIAM J. Sci. Stat.
 * Comput. 5(2), 1984. */
class KeyframePlayer {
 public:
  KeyframePlayer() = default;

  /** @param start  rad, (num_motors). @param speed  (0, 1]: divides the durations, which are
   * extended where a motor could not turn fast enough.
   * @param min_duration_ratio  As kMinDurationRatio; at least 1. */
  KeyframePlayer(const RobotModel& model, const KeyframeSequence& sequence,
                 const std::vector<double>& start, double speed,
                 double min_duration_ratio = kMinDurationRatio);

  /** s. */
  double duration() const { return stages_.empty() ? 0.0 : stages_.back().end; }
  int num_stages() const { return static_cast<int>(stages_.size()); }
  /** Time at which the last keyframe's targets are reached and its pause begins, s. */
  double last_arrival() const { return stages_.empty() ? 0.0 : stages_.back().arrival; }
  /** Time at which a stage ends, its pause included, s. */
  double end_of(int stage) const { return stages_[stage].end; }
  /** Stage (index of the keyframe) at a time since the start, s; the last one after the end. */
  int stage_at(double time) const;

  /** Targets at a time since the start, s.
   * @param position, stiffness  (num_motors), set; stiffness only where the keyframes give it. */
  void sample(double time, std::vector<double>& position, std::vector<double>& stiffness) const;

 private:
  /** Interpolation from one keyframe to the next. Times since the start of the motion, s. */
  struct Stage {
    double start;
    /** The targets are reached. */
    double arrival;
    /** The pause is over. */
    double end;
    std::vector<double> from;
    std::vector<double> to;
    /** Velocities of the targets at both ends, rad/s. */
    std::vector<double> from_velocity;
    std::vector<double> to_velocity;
    std::vector<double> stiffness;
  };

  /** Gives joints that continue in the same direction a velocity between two stages. */
  static void connect(Stage& before, Stage& after);

  std::vector<Stage> stages_;
};

}  // namespace nao::motion
