#include "tools/tuning/trial_conditions.h"

#include <algorithm>

#include "common/error.h"
#include "sim/engine.h"

namespace nao {

TrialConditions::TrialConditions(const std::vector<std::string>& engines,
                                 const std::vector<std::string>& disturbances)
    : engines_(engines) {
  const std::vector<std::string> known = sim::engine_names();
  for (const std::string& engine : engines) {
    if (std::find(known.begin(), known.end(), engine) == known.end()) {
      throw ConfigError("this build has no engine " + engine);
    }
  }
  for (std::string name : disturbances) {
    // On the command line a comma separates the sets; DisturbanceSet has one between entries.
    std::replace(name.begin(), name.end(), '+', ',');
    disturbances_.push_back(
        std::make_shared<const sim::DisturbanceSet>(sim::DisturbanceSet::find(name)));
  }
  if (count() == 0) throw ConfigError("name an engine and a set of disturbances");
}

void TrialConditions::apply(int index, ClosedLoopOptions& options) const {
  const auto i = static_cast<size_t>(index);
  options.engine = engines_[i / disturbances_.size()];
  options.disturbances = disturbances_[i % disturbances_.size()];
}

}  // namespace nao
