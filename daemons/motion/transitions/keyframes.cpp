#include "daemons/motion/transitions/keyframes.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {

double KeyframeSequence::duration() const {
  double sum = 0;
  for (const Keyframe& keyframe : keyframes) sum += keyframe.duration + keyframe.pause;
  return sum;
}

std::vector<double> mirrored(const RobotModel& model, const std::vector<double>& position) {
  std::vector<double> result = position;
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const MirrorMotor& mirror = model.symmetry().mirrors[motor];
    // q_mirror = sign * q of the partner, the reflection at the robot's xz plane.
    result[mirror.motor] = mirror.sign * position[motor];
  }
  return result;
}

KeyframeSequence mirrored(const RobotModel& model, const KeyframeSequence& sequence) {
  KeyframeSequence result = sequence;
  for (Keyframe& keyframe : result.keyframes) {
    keyframe.position = mirrored(model, keyframe.position);
    const std::vector<double> stiffness = keyframe.stiffness;
    for (int motor = 0; motor < model.num_motors(); ++motor) {
      keyframe.stiffness[model.symmetry().mirrors[motor].motor] = stiffness[motor];
    }
    // The y component of up changes its sign, and with it the order of the range's ends.
    std::swap(keyframe.up[1].least, keyframe.up[1].greatest);
    keyframe.up[1].least *= -1;
    keyframe.up[1].greatest *= -1;
  }
  return result;
}

KeyframePlayer::KeyframePlayer(const RobotModel& model, const KeyframeSequence& sequence,
                               const std::vector<double>& start, double speed,
                               double min_duration_ratio) {
  const size_t num_motors = start.size();
  std::vector<double> last = start;
  double time = 0;
  for (const Keyframe& keyframe : sequence.keyframes) {
    Stage stage;
    stage.from = last;
    stage.to = last;
    double duration = keyframe.duration / speed;
    for (size_t i = 0; i < num_motors; ++i) {
      // NaN: the joint keeps its last target.
      if (!std::isnan(keyframe.position[i])) stage.to[i] = keyframe.position[i];
      // No stage is faster than its slowest joint; all joints arrive together.
      const double distance = std::abs(stage.to[i] - stage.from[i]);
      duration = std::max(duration, min_duration_ratio * distance /
                                        model.motor_joint(static_cast<int>(i)).max_velocity);
    }
    stage.stiffness = keyframe.stiffness;
    stage.start = time;
    stage.arrival = time + duration;
    stage.end = stage.arrival + keyframe.pause;
    stage.from_velocity.assign(num_motors, 0.0);
    stage.to_velocity.assign(num_motors, 0.0);
    time = stage.end;
    last = stage.to;
    stages_.push_back(std::move(stage));
  }
  // Velocities at the keyframes after all stages are known: each needs both neighbors.
  for (size_t k = 0; k + 1 < stages_.size(); ++k) connect(stages_[k], stages_[k + 1]);
}

void KeyframePlayer::connect(Stage& before, Stage& after) {
  if (before.end > before.arrival) return;  // The targets rest in between.
  // Fritsch-Butland: the harmonic mean of the slopes on both sides, or 0 where they differ in sign.
  // The piecewise cubic is then monotone between keyframes, without overshoot.
  const double duration_before = before.arrival - before.start;
  const double duration_after = after.arrival - after.start;
  if (duration_before <= 0 || duration_after <= 0) return;
  for (size_t i = 0; i < before.from.size(); ++i) {
    const double slope_before = (before.to[i] - before.from[i]) / duration_before;
    const double slope_after = (after.to[i] - after.from[i]) / duration_after;
    if (slope_before * slope_after <= 0) continue;
    const double velocity = 2 * slope_before * slope_after / (slope_before + slope_after);
    before.to_velocity[i] = velocity;
    after.from_velocity[i] = velocity;
  }
}

int KeyframePlayer::stage_at(double time) const {
  int stage = 0;
  while (stage + 1 < num_stages() && time >= stages_[stage].end) ++stage;
  return stage;
}

void KeyframePlayer::sample(double time, std::vector<double>& position,
                            std::vector<double>& stiffness) const {
  if (stages_.empty()) return;
  const Stage& stage = stages_[stage_at(time)];
  const double duration = stage.arrival - stage.start;
  const double s = duration > 0 ? std::clamp((time - stage.start) / duration, 0.0, 1.0) : 1.0;
  // from_slope and to_slope below contain the duration, since velocities are per second.
  // Cubic Hermite basis: h01 for the distance, h10 and h11 for the velocities at both ends.
  const double to_weight = s * s * (3 - 2 * s);
  const double from_slope = s * (1 - s) * (1 - s) * duration;
  const double to_slope = -s * s * (1 - s) * duration;
  for (size_t i = 0; i < position.size(); ++i) {
    position[i] = stage.from[i] + to_weight * (stage.to[i] - stage.from[i]) +
                  from_slope * stage.from_velocity[i] + to_slope * stage.to_velocity[i];
    if (!std::isnan(stage.stiffness[i])) stiffness[i] = stage.stiffness[i];
  }
}

}  // namespace nao::motion
