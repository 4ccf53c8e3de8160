#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/robot_option.h"
#include "robot_model/scene_file.h"

namespace nao::sim {

/** Largest number of robots in a team. */
inline constexpr int kMaxTeamSize = 5;

/** Where a robot stands at the start. */
struct StartPlace {
  /** m, in W. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  /** rad, in W: 0 looks along x. */
  double heading = 0;
};

/** Gives an even number of robots, of which none has a team, teams and numbers: the first half is
 * team 0, which plays along x, the second half team 1. Other robots stay as they are. */
std::vector<RobotOption> with_teams(std::vector<RobotOption> robots);

/** Different places for all robots. A team stands in its own half and faces the other one; robots
 * without a team stand side by side, the first at the origin, and look along x.
 * @param scene  A scene without a field: places as on the field of the soccer scene.
 * @throws ConfigError  if a team has more than kMaxTeamSize robots. */
std::vector<StartPlace> start_places(const std::vector<RobotOption>& robots,
                                     const SceneFile& scene);

/** The start of a robot as its own team sees the field, x towards the opponents' goal:
 * "X,Y,HEADING" in m and degrees, as nao-vision and nao-play take it. */
std::string start_pose_text(const RobotOption& robot, const StartPlace& place);

}  // namespace nao::sim
