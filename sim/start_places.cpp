#include "sim/start_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "common/error.h"

namespace nao::sim {
namespace {

/** Distance between robots without a team, m: arms do not meet. */
constexpr double kRobotSpacing = 0.8;
/** Half the length and width of the field if the scene has none, m: the soccer scene's. */
const Eigen::Vector2d kDefaultHalfField(4.5, 3.0);
/** Places of a team by order, in halves of the field's length and width; x away from the team's own
 * goal line is less. Chosen: a striker in front of the center circle, two players behind it, a
 * keeper before the goal, one more at the side. */
constexpr std::array<std::array<double, 2>, kMaxTeamSize> kFormation{
    {{-0.24, 0}, {-0.5, 0.4}, {-0.5, -0.4}, {-0.93, 0}, {-0.3, -0.75}}};

/** Rotation of a team's frame, in which it plays along x, by half a turn for team 1. */
double sign_of(const RobotOption& robot) {
  return robot.team.value_or(0) == 0 ? 1 : -1;
}

}  // namespace

std::vector<RobotOption> with_teams(std::vector<RobotOption> robots) {
  const bool has_team = std::any_of(robots.begin(), robots.end(), [](const RobotOption& robot) {
    return robot.team.has_value();
  });
  if (has_team || robots.size() % 2 != 0) return robots;
  const size_t team_size = robots.size() / 2;
  for (size_t i = 0; i < robots.size(); ++i) {
    robots[i].team = i < team_size ? 0 : 1;
    robots[i].number = static_cast<int>(i % team_size) + 1;
  }
  return robots;
}

std::vector<StartPlace> start_places(const std::vector<RobotOption>& robots,
                                     const SceneFile& scene) {
  Eigen::Vector2d half = kDefaultHalfField;
  if (scene.field) half = Eigen::Vector2d(scene.field->length, scene.field->width) / 2;
  std::array<size_t, 2> num_in_team{};
  size_t num_alone = 0;
  std::vector<StartPlace> places;
  for (const RobotOption& robot : robots) {
    StartPlace& place = places.emplace_back();
    if (!robot.team) {
      // Alternating: 0, left, right, farther left, farther right ...
      const size_t rank = (num_alone + 1) / 2;
      const double side = num_alone % 2 == 0 ? -1 : 1;
      place.position.y() = side * kRobotSpacing * static_cast<double>(rank);
      ++num_alone;
      continue;
    }
    const size_t rank = num_in_team[static_cast<size_t>(*robot.team)]++;
    if (rank >= kFormation.size()) {
      throw ConfigError(fmt::format("team {} has more than {} robots", *robot.team, kMaxTeamSize));
    }
    place.position = sign_of(robot) *
                     half.cwiseProduct(Eigen::Vector2d(kFormation[rank][0], kFormation[rank][1]));
    place.heading = sign_of(robot) > 0 ? 0 : std::numbers::pi;
  }
  return places;
}

std::string start_pose_text(const RobotOption& robot, const StartPlace& place) {
  const Eigen::Vector2d position = sign_of(robot) * place.position;
  const double heading = place.heading - (sign_of(robot) > 0 ? 0 : std::numbers::pi);
  // Adding 0 turns -0 into 0.
  return fmt::format("{:.3f},{:.3f},{:.0f}", position.x() + 0.0, position.y() + 0.0,
                     heading * 180 / std::numbers::pi + 0.0);
}

}  // namespace nao::sim
