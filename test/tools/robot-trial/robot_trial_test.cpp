// An imported robot is simulated; what holds is in its folder.

#include "tools/robot-trial/robot_trial.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "daemons/motion/walk/gait.h"
#include "robot_import/robot_import.h"
#include "test/support/read_png.h"
#include "test/support/temporary_folder.h"
#include "test/support/test_biped.h"

namespace nao {
namespace {

TEST(RobotTrial, WritesSettingsThatHoldAndACard) {
  const TemporaryFolder folder;
  write_text(folder.path() / "biped.urdf", make_biped_urdf(TestBiped{}));
  const std::filesystem::path robot = folder.path() / "biped";
  import_robot(folder.path() / "biped.urdf", robot);
  std::vector<std::string> lines;
  // Without time for a search: its first settings only, whatever the machine's speed.
  const RobotCard card =
      try_robot(robot, 0, 0, [&](const std::string& line) { lines.push_back(line); });
  EXPECT_EQ(card.stands, card.runs);
  EXPECT_GE(card.walks, card.runs - 1) << card.failure;
  EXPECT_GT(card.speed, 0.5 * card.commanded_speed);
  EXPECT_GT(card.push, 0);
  EXPECT_THAT(lines, testing::Contains(testing::HasSubstr("stands 100 %")));
  // The files are those of the card.
  EXPECT_DOUBLE_EQ(RobotModel::load(robot).walk_limits().forward, card.commanded_speed);
  (void)motion::Gait::load(robot / "gait.yaml");
  EXPECT_EQ(read_text(robot / "card.json"), to_json(card));
  // Without OpenGL the card says so.
  EXPECT_NE(card.images.empty(), card.no_images.empty());
  for (const std::string& name : card.images) {
    const Image image = read_png(robot / name);
    // The robot is in the middle of the image, the sky at its top.
    const auto [darkest, brightest] = std::minmax_element(image.rgb.begin(), image.rgb.end());
    EXPECT_GT(*brightest - *darkest, 50) << name;
  }
  EXPECT_THAT(to_text(card), testing::HasSubstr("walks " + std::to_string(card.walks) + " of 5"));
}

TEST(RobotTrial, TellsThatARobotWithoutAGaitOnlyStands) {
  const TemporaryFolder folder;
  write_text(folder.path() / "biped.urdf", make_biped_urdf(TestBiped{}));
  const std::filesystem::path robot = folder.path() / "biped";
  import_robot(folder.path() / "biped.urdf", robot);
  std::filesystem::remove(robot / "gait.yaml");
  const RobotCard card = try_robot(robot, 0, 0, [](const std::string&) {});
  EXPECT_EQ(card.stands, card.runs);
  EXPECT_EQ(card.walks, 0);
  EXPECT_THAT(card.failure, testing::HasSubstr("no gait"));
}

}  // namespace
}  // namespace nao
