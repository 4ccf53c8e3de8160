#include "daemons/motion/actions/taught_script.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/joined.h"
#include "daemons/motion/transitions/body_state.h"
#include "daemons/motion/transitions/transition_graph.h"
#include "messages/named_joints.h"

namespace nao::motion {
namespace {

using Bounds = TaughtMotionBounds;

std::optional<Reason> find_range_fault(const char* quantity, double value, double lower,
                                       double upper) {
  // Written so that NaN fails, too.
  if (value >= lower && value <= upper) return std::nullopt;
  return Reason("motion-value-out-of-range",
                {quantity, to_argument(value), to_argument(lower), to_argument(upper)});
}

/** Motors between the root and the soles. */
std::vector<int> leg_motors(const RobotModel& model) {
  std::vector<int> motors;
  for (const LegDescription& leg : model.legs()) {
    for (const int joint : leg.joints) {
      const int motor = model.motor_of(joint);
      if (motor >= 0) motors.push_back(motor);
    }
  }
  return motors;
}

/** The list has a value for every joint of the message, motor order; NaN elsewhere. */
std::optional<Reason> read_values(const RobotModel& model, const NamedMotion& motion,
                                  const NamedMotion::Keyframe& from, Keyframe& to) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  to.position.assign(model.num_motors(), nan);
  to.stiffness.assign(model.num_motors(), nan);
  return read_named_joints(
      model.motor_names(), motion.joint_names,
      {{.quantity = "position", .values = from.position, .result = to.position, .allows_nan = true},
       {.quantity = "stiffness",
        .values = from.stiffness,
        .result = to.stiffness,
        .lower = 0,
        .upper = 1,
        .allows_nan = true}},
      JointCoverage::kSubset);
}

}  // namespace

std::optional<MotionFault> find_form_fault(const ActionScript& script) {
  const std::vector<Keyframe>& keyframes = script.sequence.keyframes;
  if (keyframes.empty() || keyframes.size() > Bounds::kMaxKeyframes) {
    return MotionFault{
        -1, Reason("motion-keyframe-count",
                   {std::to_string(keyframes.size()), std::to_string(Bounds::kMaxKeyframes)})};
  }
  if (auto reason = find_range_fault("number of repetitions", script.num_repetitions, 1,
                                     Bounds::kMaxRepetitions)) {
    return MotionFault{-1, *std::move(reason)};
  }
  for (size_t k = 0; k < keyframes.size(); ++k) {
    auto reason = find_range_fault("duration", keyframes[k].duration, Bounds::kMinDuration,
                                   Bounds::kMaxDuration);
    if (!reason) reason = find_range_fault("pause", keyframes[k].pause, 0, Bounds::kMaxDuration);
    if (reason) return MotionFault{static_cast<int>(k), *std::move(reason)};
  }
  const double total = script.sequence.duration();
  if (total > Bounds::kMaxTotal) {
    return MotionFault{
        -1, Reason("motion-too-long", {to_argument(total), to_argument(Bounds::kMaxTotal)})};
  }
  return std::nullopt;
}

std::variant<ActionScript, MotionFault> to_script(const RobotModel& model,
                                                  const NamedMotion& motion) {
  ActionScript script;
  script.sequence.name = motion.name;
  script.end = ActionScript::End::kHolds;
  script.num_repetitions = motion.num_repetitions;
  for (size_t k = 0; k < motion.keyframes.size(); ++k) {
    const NamedMotion::Keyframe& from = motion.keyframes[k];
    Keyframe keyframe;
    keyframe.duration = from.duration;
    keyframe.pause = from.pause;
    if (auto fault = read_values(model, motion, from, keyframe)) {
      return MotionFault{static_cast<int>(k), *std::move(fault)};
    }
    script.sequence.keyframes.push_back(std::move(keyframe));
  }
  if (auto fault = find_form_fault(script)) return *std::move(fault);
  script.start =
      motion.start.empty() ? find_start_posture(model, script.sequence.keyframes) : motion.start;
  if (model.find_posture(script.start) == nullptr) {
    return MotionFault{-1, Reason("posture-unknown", {script.start.substr(0, 40),
                                                      joined(model.postures(), &Posture::name)})};
  }
  return script;
}

NamedMotion to_named(const RobotModel& model, const ActionScript& script) {
  NamedMotion motion;
  motion.name = script.sequence.name;
  motion.start = script.start;
  motion.num_repetitions = script.num_repetitions;
  const std::vector<Keyframe>& keyframes = script.sequence.keyframes;
  std::vector<int> motors;
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const bool is_moved = std::any_of(keyframes.begin(), keyframes.end(), [&](const Keyframe& k) {
      return !std::isnan(k.position[motor]) || !std::isnan(k.stiffness[motor]);
    });
    if (!is_moved) continue;
    motors.push_back(motor);
    motion.joint_names.push_back(model.motor_names()[motor]);
  }
  for (const Keyframe& from : keyframes) {
    NamedMotion::Keyframe keyframe{from.duration, from.pause, {}, {}};
    for (const int motor : motors) {
      keyframe.position.push_back(from.position[motor]);
      keyframe.stiffness.push_back(from.stiffness[motor]);
    }
    motion.keyframes.push_back(std::move(keyframe));
  }
  return motion;
}

std::string find_start_posture(const RobotModel& model, const std::vector<Keyframe>& keyframes) {
  const std::vector<int> legs = leg_motors(model);
  std::string nearest = model.references().ready;
  if (keyframes.empty()) return nearest;
  const std::vector<double>& first = keyframes.front().position;
  const auto deviation = [&](const Posture& posture) {
    double sum = 0;
    for (const int motor : legs) {
      if (!std::isnan(first[motor])) sum += std::pow(first[motor] - posture.position[motor], 2);
    }
    return sum;
  };
  // The ready posture goes first: a keyframe without legs is equally near to all.
  double least = deviation(model.ready_posture());
  for (const Posture& posture : model.postures()) {
    if (posture.is_lying()) continue;
    const double candidate = deviation(posture);
    if (candidate >= least) continue;
    least = candidate;
    nearest = posture.name;
  }
  return nearest;
}

bool starts_on_feet(const RobotModel& model, const ActionScript& script) {
  const Posture* posture = model.find_posture(script.start);
  return posture == nullptr || state_of(*posture) == kOnFeet;
}

}  // namespace nao::motion
