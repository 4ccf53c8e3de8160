#include "common/robot_option.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace nao {
namespace {

TEST(RobotOption, IsANameWithAModelATeamAndANumber) {
  EXPECT_EQ(parse_robot_option("NAO").name, "NAO");
  EXPECT_EQ(parse_robot_option("NAO").model, "");
  EXPECT_EQ(parse_robot_option("NAO2:t1").model, "t1");
  EXPECT_FALSE(parse_robot_option("NAO2:t1").team.has_value());
  const RobotOption player = parse_robot_option("NAO2:t1:0:3");
  EXPECT_EQ(player.team, 0);
  EXPECT_EQ(player.number, 3);
}

TEST(RobotOption, IsRefusedWithItsFault) {
  for (const char* text : {"", "nao", "NAO 2", ":nao", "NAO:nao:1", "NAO:nao:2:1", "NAO:nao:0:0",
                           "NAO:nao:0:1:5", "NAO:nao:x:1", "NAO:nao:0:1x"}) {
    EXPECT_THROW((void)parse_robot_option(text), ConfigError) << text;
  }
}

TEST(RobotOptions, HaveTheProgramsModelAndDifferentNames) {
  const auto robots = parse_robot_options({"NAO1", "NAO2:t1"}, "nao");
  ASSERT_EQ(robots.size(), 2u);
  EXPECT_EQ(robots[0].model, "nao");
  EXPECT_EQ(robots[1].model, "t1");
  EXPECT_THROW((void)parse_robot_options({"NAO1", "NAO1:t1"}, "nao"), ConfigError);
  EXPECT_THROW((void)parse_robot_options({}, "nao"), ConfigError);
}

}  // namespace
}  // namespace nao
