#pragma once

#include <limits>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao::motion {

/** One stage of a motion that is kept as data. */
struct Keyframe {
  /** s from the stage before to this one at full speed. */
  double duration = 0;
  /** Targets at its end, rad, (num_motors); NaN: as in the stage before. */
  std::vector<double> position;
  /** Share of the motors' torque from its beginning on, (num_motors); NaN: as before. */
  std::vector<double> stiffness;
  /** s for which the targets rest afterwards, at any speed. After the last stage of a transition:
   * at most, for it is over as soon as the body is where it leads. */
  double pause = 0;
  /** What the direction of up in the torso frame must be at its end, or the motion has failed:
   * least and greatest value along x, y, z. */
  struct Range {
    double least = -std::numeric_limits<double>::infinity();
    double greatest = std::numeric_limits<double>::infinity();
    bool has(double value) const { return value >= least && value <= greatest; }
  };
  Range up[3];
};

/** A motion kept as data: a way from one state of the body to another. */
struct KeyframeSequence {
  std::string name;
  /** States that it leads from and to: a posture's name, or where the body lies. */
  std::string from;
  std::string to;
  std::vector<Keyframe> keyframes;

  /** s at full speed. */
  double duration() const;
};

/** The same motion with left and right exchanged. */
KeyframeSequence mirrored(const RobotModel& model, const KeyframeSequence& sequence);

/** Angles of a posture with left and right exchanged, rad, (num_motors). */
std::vector<double> mirrored(const RobotModel& model, const std::vector<double>& position);

/** Smooth targets through all stages, from where the joints are.
 *
 * Between stages without a pause a joint that goes on in the same direction does not stop: cubic
 * Hermite splines with the slopes of Fritsch and Carlson, "Monotone piecewise cubic interpolation",
 * SIAM J. Numer. Anal. 17(2), 1980, which never overshoot. */
class KeyframePlayer {
 public:
  KeyframePlayer() = default;

  /** @param start  rad, (num_motors). @param speed  (0, 1]: durations are divided by it, and made
   * longer where a motor would have to turn faster than it can. */
  KeyframePlayer(const RobotModel& model, const KeyframeSequence& sequence,
                 const std::vector<double>& start, double speed);

  /** s. */
  double duration() const { return stages_.empty() ? 0.0 : stages_.back().end; }
  int num_stages() const { return static_cast<int>(stages_.size()); }
  /** When the last stage's targets are reached and its pause begins, s. */
  double last_arrival() const { return stages_.empty() ? 0.0 : stages_.back().arrival; }
  /** When a stage ends, its pause included, s. */
  double end_of(int stage) const { return stages_[stage].end; }
  /** Stage that runs at a time, s since the start; the last one after the end. */
  int stage_at(double time) const;

  /** @param position, stiffness  (num_motors), set; stiffness only where the stages say so. */
  void sample(double time, std::vector<double>& position, std::vector<double>& stiffness) const;

 private:
  struct Stage {
    double start;
    /** When the targets are reached, and when the pause is over. */
    double arrival;
    double end;
    std::vector<double> from;
    std::vector<double> to;
    /** Velocities of the targets at both ends, rad/s. */
    std::vector<double> from_velocity;
    std::vector<double> to_velocity;
    std::vector<double> stiffness;
  };

  std::vector<Stage> stages_;
};

}  // namespace nao::motion
