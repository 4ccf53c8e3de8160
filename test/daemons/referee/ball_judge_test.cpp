#include "daemons/referee/ball_judge.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace nao::referee {
namespace {

struct BallJudgeTest : testing::Test {
  std::optional<BallExit> judge(double x, double y, double z = 0.05, std::optional<int> last = {}) {
    return judge_ball({x, y, z}, last, scene);
  }
  // 9 m by 6 m, lines of 5 cm, goals of 1.5 m between posts, a ball of 5 cm radius.
  SceneFile scene = SceneFile::find("soccer");
};

TEST_F(BallJudgeTest, TheWholeBallMustPassTheWholeLine) {
  EXPECT_FALSE(judge(0, 0));
  EXPECT_FALSE(judge(4.57, 0));
  EXPECT_TRUE(judge(4.58, 0));
  EXPECT_FALSE(judge(0, -3.07));
  EXPECT_TRUE(judge(0, -3.08));
}

TEST_F(BallJudgeTest, AGoalIsBetweenThePostsAndUnderTheCrossbar) {
  EXPECT_EQ(judge(4.6, 0.7)->goal_of, 0);
  EXPECT_EQ(judge(-4.6, -0.7)->goal_of, 1);
  EXPECT_FALSE(judge(4.6, 0.8)->goal_of);
  EXPECT_FALSE(judge(4.6, 0, 0.9)->goal_of);
}

TEST_F(BallJudgeTest, OverTheSideLineItGoesToTheOthersWhereItLeft) {
  const auto exit = judge(1.5, 3.2, 0.05, 0);
  EXPECT_EQ(exit->restart_team, 1);
  EXPECT_TRUE(exit->restart.isApprox(Eigen::Vector2d(1.5, 3)));
  EXPECT_EQ(judge(1.5, 3.2, 0.05, 1)->restart_team, 0);
}

TEST_F(BallJudgeTest, BesideTheGoalItIsAGoalKickOrACornerKick) {
  const auto goal_kick = judge(4.7, -1.2, 0.05, 0);
  EXPECT_EQ(goal_kick->restart_team, 1);
  EXPECT_TRUE(goal_kick->restart.isApprox(Eigen::Vector2d(3.9, -1.1)));
  const auto corner_kick = judge(4.7, -1.2, 0.05, 1);
  EXPECT_EQ(corner_kick->restart_team, 0);
  EXPECT_TRUE(corner_kick->restart.isApprox(Eigen::Vector2d(4.5, -3)));
}

TEST_F(BallJudgeTest, NeedsAField) {
  EXPECT_THROW((void)judge_ball({0, 0, 0}, {}, SceneFile::find("empty")), ConfigError);
}

}  // namespace
}  // namespace nao::referee
