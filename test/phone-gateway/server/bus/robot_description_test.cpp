#include "phone-gateway/server/bus/robot_description.h"

#include <gtest/gtest.h>

#include "common/data_path.h"
#include "test/support/temporary_folder.h"

namespace nao::gateway {
namespace {

namespace fs = std::filesystem;

/** A copy of the NAO's files in a folder that has another name than the URDF. */
class RobotDescriptionTest : public testing::Test {
 protected:
  RobotDescriptionTest() : folder_(parent_.path() / "copy") {
    const fs::path source = data_path() / "robots" / "nao";
    fs::create_directory(folder_);
    for (const char* file : {"nao.urdf", "robot.yaml", "postures.yaml"}) {
      fs::copy_file(source / file, folder_ / file);
    }
    fs::create_directory_symlink(source / "meshes", folder_ / "meshes");
  }

  TemporaryFolder parent_;
  fs::path folder_;
};

TEST_F(RobotDescriptionTest, HasThePathOfTheUrdfThatRobotYamlNames) {
  const auto robot = describe_robot("NAO", RobotModel::load(folder_));
  EXPECT_EQ(robot.name(), "NAO");
  EXPECT_EQ(robot.model(), "copy");
  EXPECT_EQ(robot.urdf_path(), "/robots/copy/nao.urdf");
}

TEST_F(RobotDescriptionTest, HasCamerasAndLimitsOfTheWalk) {
  const RobotModel model = RobotModel::load(folder_);
  const auto robot = describe_robot("NAO", model);
  ASSERT_EQ(robot.cameras_size(), static_cast<int>(model.cameras().size()));
  EXPECT_EQ(robot.cameras(0), model.cameras()[0].name);
  EXPECT_EQ(robot.max_vx(), model.walk_limits().forward);
  EXPECT_EQ(robot.min_vx(), -model.walk_limits().backward);
  EXPECT_EQ(robot.max_vy(), model.walk_limits().sideways);
  EXPECT_EQ(robot.max_wz(), model.walk_limits().turning);
  EXPECT_EQ(robot.joints_size(), model.num_motors());
}

}  // namespace
}  // namespace nao::gateway
