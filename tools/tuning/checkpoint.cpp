#include "tools/tuning/checkpoint.h"

#include <fmt/core.h>

#include "common/error.h"
#include "common/json_writer.h"
#include "common/yaml_entry.h"

namespace nao {

// The costs of all generations, with which the search is repeated on resume (see replay());
// candidates need not be stored.
std::string Checkpoint::to_text() const {
  const auto add = [](JsonWriter& json, const std::string& key, const std::vector<double>& list) {
    json.add(key, list.data(), static_cast<int>(list.size()));
  };
  JsonWriter json;
  json.begin_object();
  json.begin_object("settings");
  for (const auto& [name, value] : settings) json.add(name, value);
  json.end();
  json.begin_array("costs");
  for (const std::vector<double>& generation : costs) add(json, "", generation);
  json.end();
  add(json, "mean", mean);
  return json.take() + "\n";
}

Checkpoint Checkpoint::parse(const std::string& text, const std::string& name) {
  // JSON is a subset of YAML.
  const auto whole = YamlEntry::parse<ConfigError>(text, name);
  whole.allow_only({"settings", "costs", "mean"});
  Checkpoint checkpoint;
  for (const auto& [key, value] : whole.at("settings").entries()) {
    checkpoint.settings[key] = value.text();
  }
  for (const YamlEntry& generation : whole.at("costs").items()) {
    checkpoint.costs.push_back(generation.numbers());
    // A damaged file must not silently lead to another search.
    if (checkpoint.costs.back().size() != checkpoint.costs.front().size()) {
      generation.fail("must have as many costs as the first generation");
    }
  }
  checkpoint.mean = whole.at("mean").numbers();
  return checkpoint;
}

// A search that continues with other settings would be neither of the two.
void Checkpoint::require_settings(const std::map<std::string, std::string>& present,
                                  const std::string& name) const {
  std::string differences;
  const auto compare = [&](const std::string& key) {
    const auto get = [&](const auto& map) {
      const auto found = map.find(key);
      return found == map.end() ? std::string("(none)") : found->second;
    };
    if (get(present) == get(settings)) return;
    differences +=
        fmt::format("; {} is {}, in the checkpoint {}", key, get(present), get(settings));
  };
  for (const auto& [key, value] : present) compare(key);
  for (const auto& [key, value] : settings) {
    if (present.count(key) == 0) compare(key);
  }
  if (!differences.empty()) {
    throw ConfigError(fmt::format("{} belongs to another search: give the same options and files{}",
                                  name, differences));
  }
}

}  // namespace nao
