#include "tools/nao-trial/teach_motions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/random.h"
#include "common/yaml_entry.h"
#include "daemons/motion/actions/taught_script.h"
#include "daemons/motion/guards/joint_limits.h"
#include "daemons/motion/transitions/keyframes.h"

namespace nao::trial {
namespace {

using motion::ActionScript;
using motion::Keyframe;

/** Angles by joint or pair of joints. */
using Pose = std::map<std::string, double>;

constexpr double kKeepStiffness = std::numeric_limits<double>::quiet_NaN();

/** Time that the motors need from one pose to the next, and a little more, s. */
double needed_duration(const RobotModel& model, const std::vector<double>& from,
                       const std::vector<double>& to) {
  double duration = 0.1;
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    if (std::isnan(to[motor])) continue;
    duration =
        std::max(duration, 1.05 * motion::kMinDurationRatio * std::abs(to[motor] - from[motor]) /
                               model.motor_joint(motor).max_velocity);
  }
  return duration;
}

/** Adds a keyframe of all joints. @param slowness  Factor on the least duration, 1 or more. */
void add_keyframe(const RobotModel& model, std::vector<double>& last, std::vector<double> position,
                  double slowness, double pause, ActionScript& script) {
  motion::clip_to_limits(model, position);
  Keyframe keyframe;
  keyframe.duration = std::min(slowness * needed_duration(model, last, position),
                               motion::TaughtMotionBounds::kMaxDuration);
  keyframe.pause = pause;
  keyframe.position = position;
  keyframe.stiffness.assign(model.num_motors(), kKeepStiffness);
  script.sequence.keyframes.push_back(std::move(keyframe));
  last = std::move(position);
}

ActionScript begin_script(const std::string& name) {
  ActionScript script;
  script.sequence.name = name;
  script.end = ActionScript::End::kHolds;
  return script;
}

std::vector<bool> find_legs(const RobotModel& model) {
  std::vector<bool> is_leg(model.num_motors(), false);
  for (const LegDescription& leg : model.legs()) {
    for (const int joint : leg.joints) {
      if (model.motor_of(joint) >= 0) is_leg[model.motor_of(joint)] = true;
    }
  }
  return is_leg;
}

/** Sets the joints of a pose; a pair means both sides. */
void apply(const RobotModel& model, const Pose& pose, std::vector<double>& position) {
  for (const auto& [name, angle] : pose) {
    int motor = model.find_motor(name);
    const JointPair* pair = motor < 0 ? model.symmetry().find_pair(name) : nullptr;
    if (pair != nullptr) motor = pair->left;
    if (motor < 0) continue;
    position[motor] = angle;
    if (pair == nullptr || pair->right < 0) continue;
    std::vector<double> single(model.num_motors(), kKeepStiffness);
    single[motor] = angle;
    position[pair->right] = motion::mirrored(model, single)[pair->right];
  }
}

/** A motion through poses, each a posture with some joints changed. */
ActionScript through(const RobotModel& model, const std::string& posture,
                     const std::vector<Pose>& poses, double slowness, int repetitions) {
  ActionScript script = begin_script("good");
  script.start = posture;
  script.num_repetitions = repetitions;
  const std::vector<double>& rest = model.find_posture(posture)->position;
  std::vector<double> last = rest;
  for (const Pose& pose : poses) {
    std::vector<double> position = rest;
    apply(model, pose, position);
    add_keyframe(model, last, position, slowness, 0, script);
  }
  return script;
}

/** Moves between two postures on the feet. */
ActionScript between(const RobotModel& model, const std::string& a, const std::string& b,
                     double duration, int repetitions) {
  ActionScript script = begin_script("good");
  script.start = a;
  script.num_repetitions = repetitions;
  for (const std::string& name : {b, a}) {
    Keyframe keyframe;
    keyframe.duration = duration;
    keyframe.pause = 0.3;
    keyframe.position = model.find_posture(name)->position;
    keyframe.stiffness.assign(model.num_motors(), kKeepStiffness);
    script.sequence.keyframes.push_back(std::move(keyframe));
  }
  return script;
}

Pose read_pose(const RobotModel& model, const YamlEntry& entry) {
  Pose pose;
  for (const auto& [name, angle] : entry.entries()) {
    if (model.find_motor(name) < 0 && model.symmetry().find_pair(name) == nullptr) {
      angle.fail("is not a joint of the robot");
    }
    pose[name] = angle.number();
  }
  return pose;
}

std::string known_posture(const RobotModel& model, const YamlEntry& entry) {
  if (model.find_posture(entry.text()) == nullptr) entry.fail("is not a posture of the robot");
  return entry.text();
}

/** The same pose nearer to a posture. @param amount  0: the posture; 1: the pose. */
Pose scaled(const Pose& change, const RobotModel& model, const std::string& posture,
            double amount) {
  std::vector<double> rest = model.find_posture(posture)->position;
  Pose result;
  for (const auto& [name, angle] : change) {
    int motor = model.find_motor(name);
    const JointPair* pair = motor < 0 ? model.symmetry().find_pair(name) : nullptr;
    if (pair != nullptr) motor = pair->left;
    if (motor >= 0) result[name] = rest[motor] + amount * (angle - rest[motor]);
  }
  return result;
}

}  // namespace

ActionScript draw_taught_motion(const RobotModel& model, uint64_t seed) {
  Random random(seed * 0x9e3779b97f4a7c15u + 7);
  ActionScript script = begin_script("taught");
  const bool is_wild = seed % 2 == 1;
  const std::vector<bool> is_leg = find_legs(model);
  // Only upright and sitting postures: a person rarely teaches a robot that lies.
  std::vector<const Posture*> postures;
  for (const Posture& posture : model.postures()) {
    if (!posture.is_lying()) postures.push_back(&posture);
  }
  const Posture& posture =
      is_wild ? model.ready_posture()
              : *postures[static_cast<size_t>(random.uniform(0, double(postures.size())))];
  script.start = posture.name;
  script.num_repetitions = random.uniform() < 0.3 ? 2 : 1;
  const int num_keyframes = 1 + static_cast<int>(random.uniform(0, 6));
  // A third each: head and arms only; legs a little; legs more.
  const double kind = random.uniform();
  const double leg_spread = kind < 1. / 3 ? 0 : kind < 2. / 3 ? 0.04 : 0.15;
  const double arm_spread = random.uniform(0.05, 0.5);
  std::vector<double> last = posture.position;
  for (int k = 0; k < num_keyframes; ++k) {
    std::vector<double> position = posture.position;
    for (int motor = 0; motor < model.num_motors(); ++motor) {
      const Joint& joint = model.motor_joint(motor);
      if (is_wild) {
        position[motor] = random.uniform(joint.lower, joint.upper);
      } else {
        position[motor] += (is_leg[motor] ? leg_spread : arm_spread) * random.uniform(-1, 1);
      }
    }
    const double slowness = 1 + std::abs(random.normal()) * 3;
    const double pause = random.uniform() < 0.3 ? random.uniform(0, 1) : 0;
    add_keyframe(model, last, std::move(position), slowness, pause, script);
  }
  return script;
}

std::vector<ActionScript> make_good_motions(const RobotModel& model) {
  std::vector<ActionScript> motions;
  // The variants of a motion differ in speed, size and repetitions.
  constexpr int kNumVariants = 5;
  const YamlEntry file = YamlEntry::load(model.folder() / "good_motions.yaml");
  for (int variant = 0; variant < kNumVariants; ++variant) {
    const int repetitions = 1 + variant % 3;
    for (const YamlEntry& entry : file.items()) {
      const std::string posture = known_posture(model, entry.at("posture"));
      if (entry.has("to")) {
        motions.push_back(between(model, posture, known_posture(model, entry.at("to")),
                                  1.0 + 0.4 * variant, repetitions));
        continue;
      }
      std::vector<Pose> poses;
      for (const YamlEntry& pose : entry.at("poses").items()) {
        poses.push_back(scaled(read_pose(model, pose), model, posture, 1 - 0.15 * variant));
      }
      motions.push_back(through(model, posture, poses, 2.5 + 0.8 * variant, repetitions));
    }
  }
  return motions;
}

}  // namespace nao::trial
