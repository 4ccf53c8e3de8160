#include "tools/nao-trial/scenarios.h"

namespace nao::trial {

std::vector<Scenario> scenarios() {
  return {stand_scenario(),
          posture_graph_scenario(),
          walk_scenario(),
          sprint_scenario(),
          joystick_scenario(),
          move_to_scenario(),
          kick_scenario(),
          walk_kick_scenario(),
          block_scenario(),
          joints_scenario(),
          push_course_scenario(),
          pushes_scenario(),
          get_up_scenario(),
          commands_scenario(),
          alarms_scenario(),
          teach_scenario(),
          teach_good_scenario(),
          score_scenario(false, perception_model()),
          keep_goal_scenario(false, perception_model()),
          match_scenario(false, perception_model())};
}

}  // namespace nao::trial
