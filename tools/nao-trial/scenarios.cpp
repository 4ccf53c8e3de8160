#include "tools/nao-trial/scenarios.h"

#include "tools/nao-trial/block_scenario.h"
#include "tools/nao-trial/kick_scenario.h"
#include "tools/nao-trial/walk_scenarios.h"

namespace nao::trial {

const std::vector<std::unique_ptr<Scenario>>& scenarios() {
  static const std::vector<std::unique_ptr<Scenario>> all = [] {
    std::vector<std::unique_ptr<Scenario>> list;
    list.push_back(std::make_unique<StandScenario>());
    list.push_back(std::make_unique<PostureGraphScenario>());
    list.push_back(std::make_unique<WalkScenario>());
    list.push_back(std::make_unique<SprintScenario>());
    list.push_back(std::make_unique<JoystickScenario>());
    list.push_back(std::make_unique<MoveToScenario>());
    list.push_back(std::make_unique<WalkPushScenario>());
    list.push_back(std::make_unique<KickScenario>());
    list.push_back(std::make_unique<WalkKickScenario>());
    list.push_back(std::make_unique<BlockScenario>());
    list.push_back(std::make_unique<JointsScenario>());
    list.push_back(std::make_unique<PushScenario>());
    list.push_back(std::make_unique<GetUpScenario>());
    list.push_back(std::make_unique<CommandsScenario>());
    list.push_back(std::make_unique<AlarmsScenario>());
    return list;
  }();
  return all;
}

}  // namespace nao::trial
