#include "sim/start_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/error.h"

namespace nao::sim {
namespace {

std::vector<RobotOption> robots_named(int count) {
  std::vector<RobotOption> robots;
  for (int i = 1; i <= count; ++i) robots.push_back({"NAO" + std::to_string(i), "nao"});
  return with_teams(robots);
}

TEST(StartPlaces, PutASingleRobotAtTheOrigin) {
  const auto robots = robots_named(1);
  EXPECT_FALSE(robots[0].team.has_value());
  const StartPlace place = start_places(robots, SceneFile::find("soccer"))[0];
  EXPECT_EQ(place.position, Eigen::Vector2d::Zero());
  EXPECT_EQ(place.heading, 0);
  EXPECT_EQ(start_pose_text(robots[0], place), "0.000,0.000,0");
}

TEST(StartPlaces, AreApartForUpToTenRobots) {
  for (int count = 2; count <= 10; ++count) {
    const auto robots = robots_named(count);
    const auto places = start_places(robots, SceneFile::find("soccer"));
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < i; ++j) {
        EXPECT_GT((places[i].position - places[j].position).norm(), 0.75) << i << " " << j;
      }
    }
  }
}

TEST(StartPlaces, OfTwoTeamsAreInTheirHalvesFacingEachOther) {
  const auto robots = robots_named(10);
  const auto places = start_places(robots, SceneFile::find("soccer"));
  for (size_t i = 0; i < 10; ++i) {
    const bool is_first = i < 5;
    EXPECT_EQ(robots[i].team, is_first ? 0 : 1);
    EXPECT_EQ(robots[i].number, static_cast<int>(i % 5) + 1);
    EXPECT_LT((is_first ? 1 : -1) * places[i].position.x(), -0.8);
    EXPECT_LT(std::abs(places[i].position.x()), 4.5);
    EXPECT_LT(std::abs(places[i].position.y()), 3);
    EXPECT_LT(std::cos(places[i].heading) * places[i].position.x(), 0) << "looks at the center";
  }
  // Both teams see the field in the same way.
  EXPECT_EQ(start_pose_text(robots[1], places[1]), start_pose_text(robots[6], places[6]));
  EXPECT_EQ(start_pose_text(robots[1], places[1]), "-2.250,1.200,0");
}

TEST(StartPlaces, RefuseATeamThatIsTooLarge) {
  EXPECT_THROW(start_places(robots_named(12), SceneFile::find("soccer")), ConfigError);
}

TEST(StartPlaces, KeepTeamsThatAreGiven) {
  std::vector<RobotOption> robots{{"A", "nao", 0, 4}, {"B", "nao", 0, 2}, {"C", "nao", 1, 1}};
  robots = with_teams(robots);
  EXPECT_EQ(robots[0].number, 4);
  EXPECT_EQ(robots[1].team, 0);
  EXPECT_EQ(robots[2].team, 1);
}

}  // namespace
}  // namespace nao::sim
