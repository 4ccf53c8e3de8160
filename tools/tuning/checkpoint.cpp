#include "tools/tuning/checkpoint.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/json_text.h"

namespace nao {

using Json = nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Checkpoint, settings, costs, mean)

// The costs of all generations, with which the search is repeated on resume (see replay());
// candidates need not be stored.
std::string Checkpoint::to_text() const {
  // Names of files may be any bytes.
  return Json(*this).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Checkpoint Checkpoint::parse(const std::string& text, const std::string& name) {
  try {
    auto checkpoint = parse_json(text).get<Checkpoint>();
    for (const std::vector<double>& generation : checkpoint.costs) {
      // A damaged file must not silently lead to another search.
      if (generation.size() == checkpoint.costs.front().size()) continue;
      throw ConfigError(name + ": each generation must have as many costs as the first");
    }
    return checkpoint;
  } catch (const Json::exception& error) {
    throw ConfigError(name + ": " + error.what());
  }
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
