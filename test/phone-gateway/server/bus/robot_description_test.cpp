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

TEST_F(RobotDescriptionTest, SaysWhatTheRobotsNamesMean) {
  const auto robot = describe_robot("NAO", RobotModel::load(folder_));
  EXPECT_EQ(robot.ready_posture(), "StandInit");
  EXPECT_EQ(robot.rest_posture(), "Crouch");
  EXPECT_EQ(robot.camera_group(), "head");
  ASSERT_EQ(robot.action_roles_size(), robot.actions_size());
  EXPECT_EQ(robot.action_roles(0).name(), robot.actions(0));
  EXPECT_EQ(robot.action_roles(0).kind(), "kick");
  EXPECT_EQ(robot.action_roles(0).side(), "left");
  for (const naoremote::JointGroup& group : robot.joint_groups()) {
    EXPECT_EQ(group.is_opening(), group.name().ends_with("hand")) << group.name();
  }
}

TEST_F(RobotDescriptionTest, NamesTheMirrorImageOfEachJoint) {
  const auto robot = describe_robot("NAO", RobotModel::load(folder_));
  for (const naoremote::Joint& joint : robot.joints()) {
    if (joint.name() == "LElbowYaw") {
      EXPECT_EQ(joint.mirror_joint(), "RElbowYaw");
      EXPECT_EQ(joint.mirror_sign(), -1);
    } else if (joint.name() == "RHipPitch") {
      EXPECT_EQ(joint.mirror_joint(), "LHipPitch");
      EXPECT_EQ(joint.mirror_sign(), 1);
    } else if (joint.name() == "HeadYaw") {
      EXPECT_EQ(joint.mirror_joint(), "HeadYaw");
      EXPECT_EQ(joint.mirror_sign(), -1);
    }
  }
}

TEST_F(RobotDescriptionTest, HasTheWordsOfLabelsYaml) {
  write_text(folder_ / "labels.yaml", "postures:\n  Crouch: {en: Crouch, de: Hocken}\n");
  const auto robot = describe_robot("NAO", RobotModel::load(folder_));
  ASSERT_EQ(robot.labels_size(), 2);
  EXPECT_EQ(robot.labels(0).kind(), "posture");
  EXPECT_EQ(robot.labels(0).name(), "Crouch");
  EXPECT_EQ(robot.labels(0).language(), "de");
  EXPECT_EQ(robot.labels(0).text(), "Hocken");
}

}  // namespace
}  // namespace nao::gateway
