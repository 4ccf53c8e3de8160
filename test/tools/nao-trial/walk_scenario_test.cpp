// A walk that did not take place is not counted, and says why.

#include <gmock/gmock.h>

#include "common/data_path.h"
#include "robot_model/scene_file.h"
#include "test/support/temporary_folder.h"
#include "tools/nao-trial/scenarios.h"

namespace nao::trial {
namespace {

RunResult walk(const std::filesystem::path& folder, double speed) {
  ScenarioOptions options;
  options.trial.model = std::make_shared<const RobotModel>(RobotModel::load(folder));
  options.trial.scene = SceneFile::find("empty");
  options.velocity.x() = speed;
  options.duration = 3;
  return walk_scenario().run(options, 1).front();
}

TEST(WalkScenario, FailsBelowHalfOfTheCommandedVelocity) {
  const std::filesystem::path nao = data_path() / "robots" / "nao";
  EXPECT_TRUE(walk(nao, 0.2).is_success);
  // Far beyond its limit.
  const RunResult result = walk(nao, 2);
  EXPECT_FALSE(result.is_success);
  EXPECT_THAT(result.failure, testing::HasSubstr("too slow"));
}

TEST(WalkScenario, SucceedsWithEachRobotOfTheData) {
  for (const auto& robot : std::filesystem::directory_iterator(data_path() / "robots")) {
    if (!std::filesystem::exists(robot.path() / "robot.yaml")) continue;
    const double limit = RobotModel::load(robot.path()).walk_limits().forward;
    const RunResult result = walk(robot.path(), 0.5 * limit);
    EXPECT_TRUE(result.is_success) << robot.path() << ": " << result.failure;
  }
}

TEST(WalkScenario, WithoutAGaitARobotWalksByItsPolicyOrSaysThatItDoesNot) {
  const TemporaryFolder folder;
  const std::filesystem::path robot = folder.path() / "t1";
  std::filesystem::copy(data_path() / "robots" / "t1", robot,
                        std::filesystem::copy_options::recursive);
  std::filesystem::remove(robot / "gait.yaml");
  const RunResult result = walk(robot, 0.2);
  EXPECT_TRUE(result.is_success) << result.failure;
  std::filesystem::remove_all(robot / "policies");
  EXPECT_THAT(walk(robot, 0.2).failure, testing::HasSubstr("has no gait"));
}

}  // namespace
}  // namespace nao::trial
