#include "tools/nao-trial/vision_scenarios.h"

#include <memory>

#include "tools/nao-trial/localise_scenario.h"
#include "tools/nao-trial/match_scenario.h"
#include "tools/nao-trial/play_scenarios.h"
#include "tools/nao-trial/rendered_vision.h"

namespace nao::trial {

void add_vision_scenarios() {
  const PerceptionFactory rendered = [](ClosedLoop& trial, const SceneFile& scene,
                                        const Pose2& start, uint64_t /*seed*/, int /*team*/) {
    return std::make_unique<RenderedPerception>(trial, scene, start);
  };
  add_scenario(std::make_unique<ScoreScenario>(true, rendered));
  add_scenario(std::make_unique<KeepGoalScenario>(true, rendered));
  add_scenario(std::make_unique<MatchScenario>(true, rendered));
  add_scenario(std::make_unique<LocaliseScenario>(true));
  add_scenario(std::make_unique<LocaliseScenario>(false));
}

}  // namespace nao::trial
