#include "policy/policy_manifest.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "common/yaml_entry.h"

namespace nao {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kOwn = std::numeric_limits<double>::quiet_NaN();
// Bounds against mistakes: more than any published policy has.
constexpr double kMaxRate = 1000;
constexpr double kMaxSteps = 100;
constexpr size_t kMaxTerms = 64;
constexpr size_t kMaxConstants = 1000;
constexpr double kMaxFrequency = 20;
constexpr double kMaxDuration = 60;
constexpr double kMaxGain = 1e4;
// Chosen: from there on the robot needs its time to protect itself.
constexpr double kMaxFallTilt = 0.8;

constexpr std::array kQuantities = {"angular_velocity", "linear_velocity", "projected_gravity",
                                    "velocity_command", "linear_command",  "turn_command",
                                    "phase_sine",       "phase_cosine",    "joint_position",
                                    "joint_velocity",   "last_action",     "constant"};

/** Index of a word in a list; an error that lists them if it is none. */
template <size_t n>
size_t read_choice(const YamlEntry& entry, const std::array<const char*, n>& words) {
  const std::string word = entry.text();
  std::string all;
  for (size_t i = 0; i < n; ++i) {
    if (word == words[i]) return i;
    all += std::string(i == 0 ? "" : i + 1 == n ? " or " : ", ") + words[i];
  }
  entry.fail("must be " + all);
}

double read_number(const YamlEntry& entry, const char* key, double lower, double upper,
                   double otherwise) {
  if (!entry.has(key)) return otherwise;
  const YamlEntry value = entry.at(key);
  const double number = value.number();
  if (number < lower || number > upper) {
    value.fail("must lie between " + std::to_string(lower) + " and " + std::to_string(upper));
  }
  return number;
}

int read_steps(const YamlEntry& entry, int otherwise) {
  const double steps = read_number(entry, "steps", 1, kMaxSteps, otherwise);
  if (steps != std::floor(steps)) entry.at("steps").fail("must be an integer");
  return static_cast<int>(steps);
}

std::vector<double> read_list(const YamlEntry& entry) {
  std::vector<double> numbers = entry.numbers();
  if (numbers.empty() || numbers.size() > kMaxConstants) {
    entry.fail("must have 1 to " + std::to_string(kMaxConstants) + " numbers");
  }
  return numbers;
}

/** Fills a manifest from the entries of a file. */
class Reader {
 public:
  Reader(const RobotModel& model, PolicyManifest& manifest) : model_(model), manifest_(manifest) {}

  void read(const YamlEntry& root) {
    root.allow_only({"kind", "network", "source", "rate", "observations", "history", "phase",
                     "observation_clip", "joints", "held_joints", "observed_joints", "action",
                     "command", "duration", "fall_tilt", "recovery_margin"});
    manifest_.kind = static_cast<PolicyManifest::Kind>(
        read_choice(root.at("kind"), std::array{"walk", "get-up", "action"}));
    manifest_.network = root.at("network").text();
    if (manifest_.network.find('/') != std::string::npos) {
      root.at("network").fail("must be the name of a file in the manifest's folder");
    }
    if (root.has("source")) (void)root.at("source").text();
    (void)root.at("rate");
    manifest_.period = 1 / read_number(root, "rate", 1, kMaxRate, 0);
    manifest_.observation_clip = read_number(root, "observation_clip", 0, 1e9, kNone);
    read_joints(root);
    read_phase(root);
    read_history(root);
    read_terms(root.at("observations"));
    if (root.has("command")) read_command(root.at("command"));
    const bool walks = manifest_.kind == PolicyManifest::Kind::kWalk;
    if (walks != root.has("command")) {
      root.fail(walks ? "lacks \"command\", the limits of the commanded velocity"
                      : "must not have \"command\": only a walk has one");
    }
    if (walks == root.has("duration")) {
      root.fail(walks ? "must not have \"duration\": a walk has no end"
                      : "lacks \"duration\", in seconds");
    }
    manifest_.duration = read_number(root, "duration", 0.1, kMaxDuration, 0);
    if (root.has("fall_tilt")) {
      manifest_.fall_tilt = read_number(root, "fall_tilt", 0.1, kMaxFallTilt, 0);
    }
    if (root.has("recovery_margin")) {
      if (!walks) root.at("recovery_margin").fail("is for walks only");
      if (manifest_.phase_frequency == 0) {
        root.at("recovery_margin").fail("needs \"phase\" with a frequency");
      }
      manifest_.recovery_margin = read_number(root, "recovery_margin", -1, 1, 0);
    }
  }

 private:
  int read_motor(const YamlEntry& entry) {
    const std::string name = entry.text();
    const int motor = model_.find_motor(name);
    if (motor < 0) entry.fail("is not a joint with a motor of the robot " + model_.name());
    return motor;
  }

  PolicyJoint read_joint(const YamlEntry& entry, double scale, std::set<int>& motors) {
    entry.allow_only({"name", "default", "scale", "stiffness", "damping"});
    PolicyJoint joint;
    joint.motor = read_motor(entry.at("name"));
    if (!motors.insert(joint.motor).second) entry.at("name").fail("is listed twice");
    const Joint& limits = model_.motor_joint(joint.motor);
    joint.default_angle = read_number(entry, "default", limits.lower, limits.upper,
                                      manifest_.default_position[joint.motor]);
    joint.scale = read_number(entry, "scale", -100, 100, scale);
    joint.stiffness = read_number(entry, "stiffness", 0, kMaxGain, kOwn);
    joint.damping = read_number(entry, "damping", 0, kMaxGain, kOwn);
    manifest_.default_position[joint.motor] = joint.default_angle;
    manifest_.kp[joint.motor] = joint.stiffness;
    manifest_.kd[joint.motor] = joint.damping;
    return joint;
  }

  void read_joints(const YamlEntry& root) {
    manifest_.default_position = model_.ready_posture().position;
    manifest_.kp.assign(model_.num_motors(), kOwn);
    manifest_.kd.assign(model_.num_motors(), kOwn);
    double scale = 1;
    manifest_.action_clip = kNone;
    if (root.has("action")) {
      const YamlEntry action = root.at("action");
      action.allow_only({"scale", "clip"});
      scale = read_number(action, "scale", -100, 100, 1);
      manifest_.action_clip = read_number(action, "clip", 0, 1e9, kNone);
    }
    std::set<int> motors;
    for (const YamlEntry& entry : root.at("joints").items()) {
      manifest_.joints.push_back(read_joint(entry, scale, motors));
      manifest_.observed_motors.push_back(manifest_.joints.back().motor);
    }
    if (manifest_.joints.empty()) root.at("joints").fail("names no joint");
    if (root.has("held_joints")) {
      for (const YamlEntry& entry : root.at("held_joints").items()) read_joint(entry, 0, motors);
    }
    if (!root.has("observed_joints")) return;
    manifest_.observed_motors.clear();
    std::set<int> observed;
    for (const YamlEntry& entry : root.at("observed_joints").items()) {
      const int motor = read_motor(entry);
      if (!observed.insert(motor).second) entry.fail("is listed twice");
      manifest_.observed_motors.push_back(motor);
    }
    if (observed.empty()) root.at("observed_joints").fail("names no joint");
  }

  void read_phase(const YamlEntry& root) {
    if (!root.has("phase")) return;
    const YamlEntry phase = root.at("phase");
    phase.allow_only({"frequency", "start", "at_rest"});
    (void)phase.at("frequency");
    manifest_.phase_frequency = read_number(phase, "frequency", 0.01, kMaxFrequency, 0);
    manifest_.phase_start = read_number(phase, "start", 0, 1, 0);
    if (phase.has("at_rest")) {
      manifest_.phase_at_rest = static_cast<PolicyManifest::PhaseAtRest>(
          read_choice(phase.at("at_rest"), std::array{"continues", "zeros", "half_cycle"}));
    }
  }

  void read_history(const YamlEntry& root) {
    if (!root.has("history")) return;
    const YamlEntry history = root.at("history");
    history.allow_only({"steps", "order", "layout", "start"});
    num_steps_ = read_steps(history, 1);
    if (history.has("order")) {
      manifest_.is_newest_first =
          read_choice(history.at("order"), std::array{"oldest_first", "newest_first"}) == 1;
    }
    if (history.has("layout")) {
      manifest_.is_by_step =
          read_choice(history.at("layout"), std::array{"by_term", "by_step"}) == 1;
    }
    if (history.has("start")) {
      manifest_.starts_with_first =
          read_choice(history.at("start"), std::array{"zeros", "first"}) == 1;
    }
  }

  int size_of(const PolicyTerm& term) const {
    switch (term.quantity) {
      case PolicyQuantity::kTurnCommand:
        return 1;
      case PolicyQuantity::kLinearCommand:
        return 2;
      case PolicyQuantity::kJointPosition:
      case PolicyQuantity::kJointVelocity:
        return static_cast<int>(manifest_.observed_motors.size());
      case PolicyQuantity::kLastAction:
        return manifest_.num_actions();
      case PolicyQuantity::kPhaseSine:
      case PolicyQuantity::kPhaseCosine:
      case PolicyQuantity::kConstant:
        return static_cast<int>(term.values.size());
      default:
        return 3;
    }
  }

  void read_terms(const YamlEntry& list) {
    for (const YamlEntry& entry : list.items()) {
      manifest_.terms.push_back(read_term(entry));
      if (manifest_.terms.size() > kMaxTerms) {
        list.fail("has more than " + std::to_string(kMaxTerms) + " terms");
      }
    }
    if (manifest_.terms.empty()) list.fail("names no quantity");
  }

  PolicyTerm read_term(const YamlEntry& entry) {
    entry.allow_only({"quantity", "scale", "clip", "steps", "feet", "values"});
    PolicyTerm term;
    term.quantity = static_cast<PolicyQuantity>(read_choice(entry.at("quantity"), kQuantities));
    const bool is_phase = term.quantity == PolicyQuantity::kPhaseSine ||
                          term.quantity == PolicyQuantity::kPhaseCosine;
    const bool is_constant = term.quantity == PolicyQuantity::kConstant;
    if (is_phase && manifest_.phase_frequency == 0) entry.fail("needs \"phase\" with a frequency");
    if (entry.has("feet") && !is_phase) entry.at("feet").fail("is for phases only");
    if (entry.has("values") != is_constant) {
      entry.fail(is_constant ? "lacks \"values\"" : "must not have \"values\"");
    }
    if (is_constant) term.values = read_list(entry.at("values"));
    if (is_phase) term.values = entry.has("feet") ? read_list(entry.at("feet")) : std::vector{0.0};
    term.size = size_of(term);
    term.clip = read_number(entry, "clip", 0, 1e9, kNone);
    term.num_steps = read_steps(entry, num_steps_);
    if (manifest_.is_by_step && term.num_steps != num_steps_) {
      entry.at("steps").fail("must be that of history, whose layout is by_step");
    }
    term.scale.assign(term.size, 1.0);
    if (entry.has("scale")) read_scale(entry.at("scale"), term);
    return term;
  }

  static void read_scale(const YamlEntry& entry, PolicyTerm& term) {
    double factor = 0;
    if (entry.is_list()) {
      term.scale = entry.numbers(term.size);
      return;
    }
    factor = entry.number();
    term.scale.assign(term.size, factor);
  }

  void read_command(const YamlEntry& entry) {
    entry.allow_only({"vx", "vy", "wz"});
    const auto range = [&](const char* key) {
      const std::vector<double> bounds = entry.at(key).numbers(2);
      if (bounds[0] > 0 || bounds[1] < 0) entry.at(key).fail("must include 0");
      return PolicyRange{bounds[0], bounds[1]};
    };
    manifest_.vx = range("vx");
    manifest_.vy = range("vy");
    manifest_.wz = range("wz");
  }

  const RobotModel& model_;
  PolicyManifest& manifest_;
  int num_steps_ = 1;
};

PolicyManifest read(const RobotModel& model, const YamlEntry& root) {
  PolicyManifest manifest;
  Reader(model, manifest).read(root);
  return manifest;
}

}  // namespace

const char* to_string(PolicyQuantity quantity) {
  return kQuantities.at(static_cast<size_t>(quantity));
}

int PolicyManifest::num_observations() const {
  int count = 0;
  for (const PolicyTerm& term : terms) count += term.size * term.num_steps;
  return count;
}

PolicyManifest PolicyManifest::load(const RobotModel& model, const std::filesystem::path& file) {
  return read(model, YamlEntry::load(file));
}

PolicyManifest PolicyManifest::parse(const RobotModel& model, const std::string& text,
                                     const std::string& name) {
  return read(model, YamlEntry::parse(text, name));
}

}  // namespace nao
