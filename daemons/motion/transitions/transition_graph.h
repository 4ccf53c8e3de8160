#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/yaml_entry.h"
#include "daemons/motion/transitions/keyframes.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** States of the body and the verified transitions between them: data/robots/NAME/transitions.yaml.
 *
 * States are "on-feet" for any upright stand on both soles; "belly", "back", "left" and "right" for
 * the side on which the body lies, at any joint angles; and the sitting postures by their names.
 * A transition may also lead to a lying posture by name: see find_approach(). */
class TransitionGraph {
 public:
  /** @throws ModelError  naming the file, the line and what is wrong. */
  static TransitionGraph load(const RobotModel& model, const std::filesystem::path& file);
  /** The same from a file's text. */
  static TransitionGraph parse(const RobotModel& model, const std::string& text);

  const std::vector<KeyframeSequence>& sequences() const { return sequences_; }
  /** @return nullptr if there is none of that name. */
  const KeyframeSequence* find(const std::string& name) const;

  /** Path of least duration from one state to another (Dijkstra's algorithm).
   * @param excluded  Transitions that the path must not contain.
   * @return Empty if there is no path, or if the two states are the same. */
  std::vector<const KeyframeSequence*> find_path(
      const std::string& from, const std::string& to,
      const std::vector<const KeyframeSequence*>& excluded = {}) const;

  /** Chooses a transition between the same two states as this one, for the next attempt. They are
   * tried in the order of the file and cyclically, since a transition that failed once would fail
   * again in the same place.
   * @param num_failed  Attempts so far. */
  const KeyframeSequence& find_alternative(const KeyframeSequence& sequence, int num_failed) const;

  /** Transition to a posture from anywhere in the posture's own state, where the ground would block
   * a straight line of the joints.
   * @return nullptr if there is none. */
  const KeyframeSequence* find_approach(const Posture& posture) const;

 private:
  static TransitionGraph read(const RobotModel& model, const YamlEntry& root);

  std::vector<KeyframeSequence> sequences_;
};

/** Whether keyframes beyond a joint's limits are an error of the file, or left to the caller that
 * checks the motion. */
enum class KeyframeLimits { kChecked, kUnchecked };

/** Reads a list of keyframes: a `keyframes` entry of transitions.yaml, which documents its keys.
 * @throws ModelError  naming the line and what is wrong with it. */
std::vector<Keyframe> read_keyframes(const RobotModel& model, const YamlEntry& list,
                                     KeyframeLimits limits = KeyframeLimits::kChecked);

/** State of a posture in the graph: "on-feet" for the standing and crouching ones, "back" and
 * "belly" for the lying ones, else the posture's own name. Between two postures in one state the
 * joints may move on a straight line. */
std::string state_of(const Posture& posture);

}  // namespace nao::motion
