#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/yaml_entry.h"
#include "daemons/motion/transitions/keyframes.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Where the body can be, and the verified ways between: robots/NAME/transitions.yaml.
 *
 * States are "on-feet" for any upright stand on both soles, "belly", "back", "left" and "right" for
 * how a body lies, whatever its joints do, and the sitting postures by their names. A sequence may
 * also lead to a lying posture by name: see find_approach(). */
class TransitionGraph {
 public:
  /** @throws ModelError  naming the file, the line and what is wrong. */
  static TransitionGraph load(const RobotModel& model, const std::filesystem::path& file);
  /** The same from a file's text. */
  static TransitionGraph parse(const RobotModel& model, const std::string& text);

  const std::vector<KeyframeSequence>& sequences() const { return sequences_; }
  /** @return nullptr if there is none of that name. */
  const KeyframeSequence* find(const std::string& name) const;

  /** Quickest chain of sequences from one state to another.
   * @param without  Sequences that it must do without.
   * @return Empty if there is none, or if the two are the same. */
  std::vector<const KeyframeSequence*> find_way(
      const std::string& from, const std::string& to,
      const std::vector<const KeyframeSequence*>& without = {}) const;

  /** Of the sequences between the same two states as this one, the one for the n-th try, from 0, in
   * the order of the file and over again: what failed once in some place fails there again. */
  const KeyframeSequence& find_alternative(const KeyframeSequence& sequence, int num_failed) const;

  /** Sequence that leads from anyhow in a posture's own state to that posture, where a straight
   * turn of the joints would be stopped by the ground.
   * @return nullptr if there is none. */
  const KeyframeSequence* find_approach(const Posture& posture) const;

 private:
  static TransitionGraph read(const RobotModel& model, const YamlEntry& root);

  std::vector<KeyframeSequence> sequences_;
};

/** Reads a list of keyframes: a `keyframes` entry of transitions.yaml, which says what its keys
 * mean.
 * @throws ModelError  naming the line and what is wrong with it. */
std::vector<Keyframe> read_keyframes(const RobotModel& model, const YamlEntry& list);

/** State of a posture in the graph: "on-feet" for the standing and crouching ones, "back" and
 * "belly" for the lying ones, else the posture's own name. Between two postures in one state all
 * joints may go straight. */
std::string state_of(const Posture& posture);

}  // namespace nao::motion
