#include "daemons/motion/actions/action_script.h"

#include <algorithm>

#include "common/yaml_entry.h"
#include "daemons/motion/transitions/transition_graph.h"

namespace nao::motion {
namespace {

const ActionScript* find(const std::vector<ActionScript>& scripts, const std::string& name) {
  const auto found = std::find_if(scripts.begin(), scripts.end(), [&](const ActionScript& script) {
    return script.sequence.name == name;
  });
  return found == scripts.end() ? nullptr : &*found;
}

ActionScript read(const RobotModel& model, const YamlEntry& entry) {
  entry.allow_only({"name", "balance_gain", "end", "keyframes"});
  ActionScript script;
  script.sequence.keyframes = read_keyframes(model, entry.at("keyframes"));
  script.balance_gain = entry.at("balance_gain").not_negative();
  const std::string end = entry.at("end").text();
  if (end != "on-feet" && end != "gets-up") entry.at("end").fail("must be on-feet or gets-up");
  script.end = end == "on-feet" ? ActionScript::End::kOnFeet : ActionScript::End::kGetsUp;
  return script;
}

}  // namespace

std::vector<ActionScript> ActionScript::load(const RobotModel& model,
                                             const std::filesystem::path& file) {
  const YamlEntry root = YamlEntry::load(file);
  root.allow_only({"actions"});
  std::vector<ActionScript> scripts;
  for (const YamlEntry& entry : root.at("actions").items()) {
    ActionScript script;
    // Mirrors a script that is above it in the file; everything else is the original's.
    if (entry.has("mirrors")) {
      entry.allow_only({"name", "mirrors"});
      const ActionScript* original = find(scripts, entry.at("mirrors").text());
      if (original == nullptr) entry.at("mirrors").fail("no such action above");
      script = *original;
      script.sequence = mirrored(model, original->sequence);
    } else {
      script = read(model, entry);
    }
    script.sequence.name = entry.at("name").text();
    if (find(scripts, script.sequence.name) != nullptr) entry.at("name").fail("is there twice");
    scripts.push_back(std::move(script));
  }
  return scripts;
}

}  // namespace nao::motion
