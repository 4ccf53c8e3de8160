#include <memory>

#include "tools/nao-trial/rendered_vision.h"
#include "tools/nao-trial/scenarios.h"

namespace nao::trial {

std::vector<Scenario> vision_scenarios() {
  const PerceptionFactory rendered = [](ClosedLoop& trial, const SceneFile& scene,
                                        const Pose2& start, uint64_t /*seed*/, int /*team*/) {
    return std::make_unique<RenderedPerception>(trial, scene, start);
  };
  return {score_scenario(true, rendered), keep_goal_scenario(true, rendered),
          match_scenario(true, rendered), localise_scenario(true), localise_scenario(false)};
}

}  // namespace nao::trial
