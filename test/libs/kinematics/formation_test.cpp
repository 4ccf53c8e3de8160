#include "kinematics/formation.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

const Eigen::Vector2d kHalfField(4.5, 3);

TEST(Formation, TeamsSeeTheFieldFromOppositeEnds) {
  EXPECT_TRUE((team_in_field(0) * Eigen::Vector2d(1, 2)).isApprox(Eigen::Vector2d(1, 2)));
  EXPECT_TRUE((team_in_field(1) * Eigen::Vector2d(1, 2)).isApprox(Eigen::Vector2d(-1, -2)));
}

TEST(Formation, EveryPlaceIsInTheOwnHalfAndApartFromTheOthers) {
  for (int size = 1; size <= 5; ++size) {
    for (const bool kicks_off : {false, true}) {
      for (int number = 1; number <= size; ++number) {
        const Eigen::Vector2d place = kick_off_place(number, size, kicks_off, kHalfField).position;
        EXPECT_LT(place.x(), 0);
        EXPECT_GT(place.x(), -kHalfField.x());
        EXPECT_LT(std::abs(place.y()), kHalfField.y());
        // The centre circle is the kicking team's.
        EXPECT_TRUE(kicks_off || place.norm() > 0.85);
        for (int other = 1; other < number; ++other) {
          EXPECT_GT((kick_off_place(other, size, kicks_off, kHalfField).position - place).norm(),
                    1);
        }
      }
    }
  }
}

TEST(Formation, OneIsAtTheBallAndTheLastKeepsTheGoal) {
  EXPECT_GT(kick_off_place(1, 2, true, kHalfField).position.x(), -0.5);
  EXPECT_LT(kick_off_place(2, 2, true, kHalfField).position.x(), -4);
  // A single player plays rather than keeps the goal.
  EXPECT_GT(kick_off_place(1, 1, false, kHalfField).position.x(), -1.5);
}

TEST(RestartPlace, IsOnTheLineOrAtTheEndOfTheFieldByWhoGoesOn) {
  const Eigen::Vector2d half(4.5, 3);
  const Eigen::Vector2d area(0.6, 2.2);
  using Eigen::Vector2d;
  EXPECT_EQ(restart_place({1, -3.2}, true, half, area), Vector2d(1, -3));
  EXPECT_EQ(restart_place({1, 2.5}, false, half, area), Vector2d(1, 3)) << "seen before the line";
  EXPECT_EQ(restart_place({4.8, 1}, true, half, area), Vector2d(4.5, 3)) << "own corner kick";
  EXPECT_EQ(restart_place({4.8, 1}, false, half, area), Vector2d(3.9, 1.1)) << "their goal kick";
  EXPECT_EQ(restart_place({-4.8, -1}, true, half, area), Vector2d(-3.9, -1.1)) << "own goal kick";
  EXPECT_EQ(restart_place({-4.8, -1}, false, half, area), Vector2d(-4.5, -3));
}

}  // namespace
}  // namespace nao
