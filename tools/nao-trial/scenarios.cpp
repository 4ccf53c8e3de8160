#include "tools/nao-trial/scenarios.h"

#include "tools/nao-trial/block_scenario.h"
#include "tools/nao-trial/kick_scenario.h"
#include "tools/nao-trial/match_scenario.h"
#include "tools/nao-trial/play_scenarios.h"
#include "tools/nao-trial/teach_scenario.h"
#include "tools/nao-trial/walk_scenarios.h"

namespace nao::trial {
namespace {

std::vector<std::unique_ptr<Scenario>>& all_scenarios() {
  static std::vector<std::unique_ptr<Scenario>> all = [] {
    std::vector<std::unique_ptr<Scenario>> list;
    list.push_back(std::make_unique<StandScenario>());
    list.push_back(std::make_unique<PostureGraphScenario>());
    list.push_back(std::make_unique<WalkScenario>());
    list.push_back(std::make_unique<SprintScenario>());
    list.push_back(std::make_unique<JoystickScenario>());
    list.push_back(std::make_unique<MoveToScenario>());
    list.push_back(std::make_unique<KickScenario>());
    list.push_back(std::make_unique<WalkKickScenario>());
    list.push_back(std::make_unique<BlockScenario>());
    list.push_back(std::make_unique<JointsScenario>());
    list.push_back(std::make_unique<PushCourseScenario>());
    list.push_back(std::make_unique<GetUpScenario>());
    list.push_back(std::make_unique<CommandsScenario>());
    list.push_back(std::make_unique<AlarmsScenario>());
    list.push_back(std::make_unique<TeachScenario>());
    list.push_back(std::make_unique<TeachGoodScenario>());
    list.push_back(std::make_unique<ScoreScenario>(false, perception_model()));
    list.push_back(std::make_unique<KeepGoalScenario>(false, perception_model()));
    list.push_back(std::make_unique<MatchScenario>(false, perception_model()));
    return list;
  }();
  return all;
}

}  // namespace

const std::vector<std::unique_ptr<Scenario>>& scenarios() {
  return all_scenarios();
}

void add_scenario(std::unique_ptr<Scenario> scenario) {
  all_scenarios().push_back(std::move(scenario));
}

}  // namespace nao::trial
