#include "daemons/motion/transitions/transition_graph.h"

#include <algorithm>
#include <limits>
#include <set>

#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/** Motors of a name: one joint, or both joints of a mirrored pair. -1: none. */
struct Motors {
  int left = -1;
  int right = -1;
};

Motors find_motors(const RobotModel& model, const std::string& name) {
  const int motor = model.find_motor(name);
  if (motor >= 0) return {motor, -1};
  const JointPair* pair = model.symmetry().find_pair(name);
  return pair != nullptr ? Motors{pair->left, pair->right} : Motors{};
}

void read_joints(const RobotModel& model, const YamlEntry& joints, KeyframeLimits limits,
                 std::vector<double>& position) {
  for (const auto& [name, value] : joints.entries()) {
    const Motors motors = find_motors(model, name);
    if (motors.left < 0) joints.fail("no joint " + name);
    // mirrored() takes all joints: a list in which only this one has a value.
    std::vector<double> single(model.num_motors(), kNan);
    single[motors.left] = value.number();
    position[motors.left] = single[motors.left];
    if (motors.right >= 0) position[motors.right] = mirrored(model, single)[motors.right];
  }
  if (limits == KeyframeLimits::kUnchecked) return;
  // The limits are checked after all joints are read, posture and single joints together.
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const Joint& joint = model.motor_joint(motor);
    if (position[motor] < joint.lower - 1e-9 || position[motor] > joint.upper + 1e-9) {
      joints.fail(joint.name + " is beyond its limits");
    }
  }
}

void read_stiffness(const RobotModel& model, const YamlEntry& entry,
                    std::vector<double>& stiffness) {
  for (const auto& [name, value] : entry.entries()) {
    const double fraction = value.number();
    if (fraction < 0 || fraction > 1) value.fail("must be 0 to 1");
    if (name == "all") {
      std::fill(stiffness.begin(), stiffness.end(), fraction);
      continue;
    }
    const Motors motors = find_motors(model, name);
    if (motors.left < 0) entry.fail("no joint " + name);
    stiffness[motors.left] = fraction;
    if (motors.right >= 0) stiffness[motors.right] = fraction;
  }
}

Keyframe read_keyframe(const RobotModel& model, const YamlEntry& entry, KeyframeLimits limits) {
  entry.allow_only({"duration", "posture", "joints", "stiffness", "pause", "ankle_damping", "up"});
  Keyframe keyframe;
  keyframe.duration = entry.at("duration").number();
  if (keyframe.duration < 0) entry.at("duration").fail("must not be negative");
  keyframe.position.assign(model.num_motors(), kNan);
  keyframe.stiffness.assign(model.num_motors(), kNan);
  if (entry.has("posture")) {
    const Posture* posture = model.find_posture(entry.at("posture").text());
    if (posture == nullptr) entry.at("posture").fail("no such posture");
    keyframe.position = posture->position;
  }
  if (entry.has("joints")) read_joints(model, entry.at("joints"), limits, keyframe.position);
  if (entry.has("stiffness")) read_stiffness(model, entry.at("stiffness"), keyframe.stiffness);
  if (entry.has("pause")) keyframe.pause = entry.at("pause").number();
  if (keyframe.pause < 0) entry.at("pause").fail("must not be negative");
  if (entry.has("ankle_damping")) keyframe.ankle_damping = entry.at("ankle_damping").number();
  if (keyframe.ankle_damping < 0) entry.at("ankle_damping").fail("must not be negative");
  if (entry.has("up")) {
    const YamlEntry up = entry.at("up");
    up.allow_only({"x", "y", "z"});
    for (const auto& [axis, range] : up.entries()) {
      const std::vector<double> limits = range.numbers(2);
      keyframe.up[axis[0] - 'x'] = {limits[0], limits[1]};
    }
  }
  return keyframe;
}

}  // namespace

std::vector<Keyframe> read_keyframes(const RobotModel& model, const YamlEntry& list,
                                     KeyframeLimits limits) {
  std::vector<Keyframe> keyframes;
  for (const YamlEntry& entry : list.items()) {
    keyframes.push_back(read_keyframe(model, entry, limits));
  }
  if (keyframes.empty()) list.fail("has no keyframe");
  return keyframes;
}

// States of the graph: on feet, lying sides, and each sitting posture by its own name.
std::string state_of(const Posture& posture) {
  if (posture.family == "standing" || posture.family == "crouching") return kOnFeet;
  if (posture.family == "lying-back") return "back";
  if (posture.family == "lying-belly") return "belly";
  return posture.name;
}

TransitionGraph TransitionGraph::load(const RobotModel& model, const std::filesystem::path& file) {
  return read(model, YamlEntry::load(file));
}

TransitionGraph TransitionGraph::parse(const RobotModel& model, const std::string& text) {
  return read(model, YamlEntry::parse(text, "transitions"));
}

TransitionGraph TransitionGraph::read(const RobotModel& model, const YamlEntry& root) {
  TransitionGraph graph;
  root.allow_only({"transitions"});
  std::set<std::string> states = {kOnFeet, "belly", "back", "left", "right"};
  for (const Posture& posture : model.postures()) states.insert(state_of(posture));
  // In the file's order: a mirrored transition must stand below its original.
  for (const YamlEntry& entry : root.at("transitions").items()) {
    entry.allow_only({"name", "from", "to", "mirrors", "keyframes"});
    KeyframeSequence sequence;
    if (entry.has("mirrors")) {
      const KeyframeSequence* original = graph.find(entry.at("mirrors").text());
      if (original == nullptr) entry.at("mirrors").fail("no such transition above");
      sequence = mirrored(model, *original);
    } else {
      sequence.keyframes = read_keyframes(model, entry.at("keyframes"));
    }
    sequence.name = entry.at("name").text();
    sequence.from = entry.at("from").text();
    sequence.to = entry.at("to").text();
    if (states.count(sequence.from) == 0) entry.at("from").fail("no such state");
    if (states.count(sequence.to) == 0 && model.find_posture(sequence.to) == nullptr) {
      entry.at("to").fail("no such state or posture");
    }
    if (graph.find(sequence.name) != nullptr) entry.at("name").fail("is there twice");
    graph.sequences_.push_back(std::move(sequence));
  }
  return graph;
}

const KeyframeSequence* TransitionGraph::find(const std::string& name) const {
  for (const KeyframeSequence& sequence : sequences_) {
    if (sequence.name == name) return &sequence;
  }
  return nullptr;
}

// All transitions between the same two states are alternatives, in the file's order.
const KeyframeSequence& TransitionGraph::find_alternative(const KeyframeSequence& sequence,
                                                          int num_failed) const {
  std::vector<const KeyframeSequence*> alternatives;
  for (const KeyframeSequence& other : sequences_) {
    if (other.from == sequence.from && other.to == sequence.to) alternatives.push_back(&other);
    // Contains at least `sequence` itself, so that the modulus is not 0.
  }
  return *alternatives[static_cast<size_t>(num_failed) % alternatives.size()];
}

// Transition within a state that ends in a posture.
const KeyframeSequence* TransitionGraph::find_approach(const Posture& posture) const {
  for (const KeyframeSequence& sequence : sequences_) {
    if (sequence.to == posture.name && sequence.from == state_of(posture)) return &sequence;
  }
  return nullptr;
}

std::vector<const KeyframeSequence*> TransitionGraph::find_path(
    const std::string& from, const std::string& to,
    const std::vector<const KeyframeSequence*>& excluded) const {
  // Dijkstra's algorithm with a linear search for the nearest node: the graph has a dozen nodes.
  struct Reached {
    std::string state;
    double duration = 0;
    const KeyframeSequence* last = nullptr;
    bool is_settled = false;
  };
  // In the order in which they are reached: it decides between paths of one duration.
  std::vector<Reached> reached = {{from}};
  const auto find_reached = [&](const std::string& state) {
    return std::find_if(reached.begin(), reached.end(),
                        [&](const Reached& node) { return node.state == state; });
  };
  for (;;) {
    auto nearest = reached.end();
    for (auto it = reached.begin(); it != reached.end(); ++it) {
      if (it->is_settled) continue;
      if (nearest == reached.end() || it->duration < nearest->duration) nearest = it;
    }
    // Durations are not negative: no later node can shorten the path to the nearest one.
    if (nearest == reached.end() || nearest->state == to) break;
    nearest->is_settled = true;
    const Reached node = *nearest;
    for (const KeyframeSequence& sequence : sequences_) {
      if (sequence.from != node.state) continue;
      if (std::find(excluded.begin(), excluded.end(), &sequence) != excluded.end()) continue;
      const double duration = node.duration + sequence.duration();
      const auto other = find_reached(sequence.to);
      if (other == reached.end()) {
        reached.push_back({sequence.to, duration, &sequence});
      } else if (duration < other->duration) {
        other->duration = duration;
        other->last = &sequence;
      }
    }
  }
  // Back from the goal along the last transitions.
  std::vector<const KeyframeSequence*> path;
  auto node = find_reached(to);
  while (node != reached.end() && node->last != nullptr) {
    path.push_back(node->last);
    node = find_reached(node->last->from);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace nao::motion
