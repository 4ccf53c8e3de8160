#include "daemons/play/play_parameters.h"

#include "common/data_path.h"
#include "common/parameter_table.h"

namespace nao::play {
namespace {

NAO_PARAMETER_TABLE(PlayParameters, approach, shot_aim, ball_in_walk, rolling_ball, ball_memory,
                    ball_search, head_control, keeper, positioner, robot_memory, auto_player,
                    striker)

}  // namespace

PlayParameters PlayParameters::load(const std::filesystem::path& robot_file) {
  return load_parameters(data_path() / "play" / "parameters.yaml", robot_file, all_parameters());
}

}  // namespace nao::play
