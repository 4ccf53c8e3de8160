#include "daemons/motion-files/motion_text.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "common/error.h"
#include "common/yaml_entry.h"
#include "daemons/motion/actions/taught_script.h"
#include "daemons/motion/transitions/transition_graph.h"
#include "messages/motion_file.h"

namespace nao {
namespace {

using motion::ActionScript;
using motion::Keyframe;

int read_repetitions(const YamlEntry& entry) {
  const double number = entry.positive();
  const bool is_count =
      number == std::floor(number) && number <= motion::TaughtMotionBounds::kMaxRepetitions;
  if (!is_count) {
    entry.fail(fmt::format("must be a whole number up to {}",
                           motion::TaughtMotionBounds::kMaxRepetitions));
  }
  return static_cast<int>(number);
}

/** {HeadYaw: 0.1, HeadPitch: 0}; empty if no joint has a value. */
std::string flow_map(const RobotModel& model, const std::vector<double>& values) {
  std::string text;
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    if (std::isnan(values[motor])) continue;
    // Not -0, and no digits beyond what an encoder resolves.
    const double value = values[motor] == 0 ? 0 : values[motor];
    text +=
        fmt::format("{}{}: {:.6g}", text.empty() ? "" : ", ", model.motor_names()[motor], value);
  }
  return text.empty() ? "" : "{" + text + "}";
}

}  // namespace

ActionScript parse_motion(const RobotModel& model, const std::string& text,
                          const std::string& source) {
  if (text.size() > kMaxMotionTextBytes) {
    throw ModelError(fmt::format("{} has {} bytes; at most {} are allowed", source, text.size(),
                                 kMaxMotionTextBytes));
  }
  const YamlEntry root = YamlEntry::parse(text, source);
  root.allow_only({"actions"});
  const std::vector<YamlEntry> entries = root.at("actions").items();
  if (entries.size() != 1) root.at("actions").fail("must have one entry");
  const YamlEntry& entry = entries.front();
  entry.allow_only({"name", "start", "repetitions", "balance_gain", "end", "keyframes"});
  ActionScript script;
  script.sequence.name = entry.at("name").text();
  if (!is_motion_name(script.sequence.name)) {
    entry.at("name").fail("must be 1 to 40 letters, digits, - and _");
  }
  if (entry.has("repetitions")) script.num_repetitions = read_repetitions(entry.at("repetitions"));
  if (entry.has("balance_gain") && entry.at("balance_gain").number() != 0) {
    entry.at("balance_gain").fail("must be 0 in a taught motion");
  }
  if (entry.has("end") && entry.at("end").text() != "holds") {
    entry.at("end").fail("must be holds in a taught motion");
  }
  script.end = ActionScript::End::kHolds;
  script.sequence.keyframes =
      read_keyframes(model, entry.at("keyframes"), motion::KeyframeLimits::kUnchecked);
  for (const Keyframe& keyframe : script.sequence.keyframes) {
    for (const Keyframe::Range& range : keyframe.up) {
      if (std::isfinite(range.least) || std::isfinite(range.greatest)) {
        entry.at("keyframes").fail("must not have the key up in a taught motion");
      }
    }
  }
  if (entry.has("start")) {
    script.start = entry.at("start").text();
    if (model.find_posture(script.start) == nullptr) entry.at("start").fail("no such posture");
  } else {
    script.start = motion::find_start_posture(model, script.sequence.keyframes);
  }
  return script;
}

std::string to_yaml(const RobotModel& model, const ActionScript& script) {
  std::string text = fmt::format(
      "# A taught motion; rad, s. Keys: docs/teaching.md.\n"
      "actions:\n"
      "  - name: {}\n"
      "    start: {}\n"
      "    repetitions: {}\n"
      "    balance_gain: 0\n"
      "    end: holds\n"
      "    keyframes:\n",
      script.sequence.name, script.start, script.num_repetitions);
  for (const Keyframe& keyframe : script.sequence.keyframes) {
    text += fmt::format("      - duration: {:.6g}\n", keyframe.duration);
    const std::string joints = flow_map(model, keyframe.position);
    if (!joints.empty()) text += "        joints: " + joints + "\n";
    const std::string stiffness = flow_map(model, keyframe.stiffness);
    if (!stiffness.empty()) text += "        stiffness: " + stiffness + "\n";
    if (keyframe.pause > 0) text += fmt::format("        pause: {:.6g}\n", keyframe.pause);
  }
  return text;
}

}  // namespace nao
