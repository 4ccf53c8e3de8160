#include "lola/lola_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "common/data_path.h"
#include "common/error.h"
#include "test/libs/robot_model/copied_robot.h"

namespace nao {
namespace {

const RobotModel& nao_robot() {
  static const RobotModel model = RobotModel::load(data_path() / "robots/nao");
  return model;
}

TEST(LolaMap, NamesTheJointsInTheVendorsOrder) {
  const LolaMap map = LolaMap::load(nao_robot());
  // First, some in between, and last of the order in docs/real-robot.md.
  const std::vector<std::pair<size_t, std::string>> expected{
      {0, "HeadYaw"},     {1, "HeadPitch"}, {2, "LShoulderPitch"},  {7, "LHipYawPitch"},
      {10, "LKneePitch"}, {13, "RHipRoll"}, {18, "RShoulderPitch"}, {22, "RWristYaw"},
      {23, "LHand"},      {24, "RHand"}};
  for (const auto& [index, name] : expected) {
    EXPECT_EQ(nao_robot().motor_names()[static_cast<size_t>(map.joints[index].motor)], name);
  }
}

TEST(LolaMap, ConvertsBothWays) {
  LolaMap map = LolaMap::load(nao_robot());
  map.joints[3].sign = -1;
  std::vector<double> values(kLolaJoints);
  for (size_t i = 0; i < values.size(); ++i) values[i] = 0.25 * static_cast<double>(i);
  const auto motor = static_cast<size_t>(map.joints[3].motor);
  EXPECT_EQ(map.to_lola(values, true)[3], static_cast<float>(-values[motor]));
  EXPECT_EQ(map.to_lola(values, false)[3], static_cast<float>(values[motor]));
  std::vector<double> back(kLolaJoints);
  map.from_lola(map.to_lola(values, true), true, back);
  EXPECT_EQ(back, values);
}

TEST(LolaMap, ShowsColorsWithColoredAndWhiteLights) {
  LolaCommand command;
  EXPECT_TRUE(set_light(command, "LEye", {0.25, 0.5, 1}));
  EXPECT_EQ((*command.left_eye)[7], 0.25f);
  EXPECT_EQ((*command.left_eye)[8], 0.5f);
  EXPECT_EQ((*command.left_eye)[23], 1);
  EXPECT_TRUE(set_light(command, "Skull", {0.25, 0.5, 0}));
  EXPECT_THAT(*command.skull, testing::Each(0.5f));
  EXPECT_FALSE(set_light(command, "Position", {0, 0, 0}));
  EXPECT_FALSE(set_light(command, "Tail", {0, 0, 0}));
  EXPECT_THAT(light_color(command, "LEye"), testing::ElementsAre(0.25, 0.5, 1));
  EXPECT_THAT(light_color(command, "Skull"), testing::Each(testing::DoubleNear(0.5, 1e-9)));
  EXPECT_THAT(light_color(command, "Chest"), testing::Each(0));
}

/** Error of a copy of the file in which a text was replaced. */
std::string error_with(const std::string& from, const std::string& to) {
  const CopiedRobot robot;
  std::string text = read_text(data_path() / "robots/nao/lola.yaml");
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  robot.write("lola.yaml", text.replace(at, from.size(), to));
  try {
    (void)LolaMap::load(RobotModel::load(robot.path()));
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(LolaMap, NamesFileAndEntryOfAnError) {
  using testing::HasSubstr;
  EXPECT_THAT(error_with("joint: HeadYaw,", "joint: Tail,"), HasSubstr("\"Tail\""));
  EXPECT_THAT(error_with("joint: HeadYaw,", "joint: HeadPitch,"), HasSubstr("second time"));
  EXPECT_THAT(error_with("sign: 1}", "sign: 2}"), HasSubstr("must be 1 or -1"));
  EXPECT_THAT(error_with("LFsrFL", "LSole"), HasSubstr("foot sensor"));
  EXPECT_THAT(error_with("left-eye: LEye", "left-eye: Position"), HasSubstr("LoLA's commands"));
  EXPECT_THAT(error_with("start_button: chest", "start_button: belly"), HasSubstr("lola.yaml"));
  EXPECT_THAT(error_with("sonars: [left, right]", "sonars: [left]"), HasSubstr("must have 2"));
}

}  // namespace
}  // namespace nao
