// Frame, legs and soles come from the geometry, whatever the file's frames and names are.

#include "robot_import/robot_structure.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"
#include "robot_import/description_text.h"
#include "robot_import/gait_text.h"
#include "sim/closed_loop/closed_loop.h"
#include "test/libs/robot_import/imported_urdf.h"

namespace nao {
namespace {

using testing::Contains;
using testing::HasSubstr;

class ImportedStructure : public ImportedUrdf {
 protected:
  /** Puts the robot into the frame of another root. */
  void move_root(const std::string& origin) {
    replace("<link name=\"trunk\">", "<link name=\"trunk\">",
            "<link name=\"base\"/><joint name=\"base_mount\" type=\"fixed\"><parent link=\"base\"/>"
            "<child link=\"trunk\"/><origin " +
                origin + "/></joint><link name=\"trunk\">");
  }
  void remove_shape(const std::string& foot) {
    const size_t at = urdf_.find("<collision", urdf_.find("<link name=\"" + foot + "\""));
    urdf_.erase(at, urdf_.find("</collision>", at) + 12 - at);
  }
  static bool stands(const RobotModel& model) {
    ClosedLoopOptions options;
    options.model = std::make_shared<const RobotModel>(model);
    ClosedLoop trial(options, 1);
    trial.run(5);
    return trial.torso_tilt() < 0.1 &&
           trial.torso_height() > 0.95 * model.references().heights.standing;
  }
  static Eigen::Vector2d size_of(const std::vector<Eigen::Vector2d>& outline) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : outline) box.extend(corner);
    return box.sizes();
  }
  /** A link is above the robot's sole of that side. */
  static std::string foot_of(const RobotModel& model, int side) {
    const int mount = model.links()[model.legs()[side].sole].parent_joint;
    return model.links()[model.joints()[mount].parent_link].name;
  }
};

TEST_F(ImportedStructure, HasAnotherRootWhereTheFrameIsTurnedOrMoved) {
  const std::string whole = urdf_;
  for (const std::string origin :
       {"rpy=\"0 0 3.14159265358979\"", "rpy=\"0 0 1.5707963267949\"",
        "rpy=\"-1.5707963267949 0 0\"", "xyz=\"0.3 0.02 -0.1\" rpy=\"0 0 -1.5707963267949\"",
        "xyz=\"0 0.018 0\""}) {
    urdf_ = whole;
    move_root(origin);
    const RobotModel model = import();
    EXPECT_EQ(foot_of(model, 0), "left_foot") << origin;
    const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0));
    EXPECT_TRUE(poses[model.find_link("trunk")].linear().isIdentity(1e-6)) << origin;
    EXPECT_NEAR(poses[model.find_link("trunk")].translation().y(), 0, 1e-6) << origin;
    EXPECT_THAT(lines_, Contains(HasSubstr("a new root with the robot's frame"))) << origin;
    EXPECT_NO_THROW(LegKinematics{model}) << origin;
  }
}

// A world below which the robot stands is no part of it.
TEST_F(ImportedStructure, HasLegsWhereverAWorldIs) {
  for (const char* z : {"1", "-3"}) {
    urdf_ = make_biped_urdf(TestBiped{});
    replace("<link name=\"trunk\">", "<link name=\"trunk\">",
            "<link name=\"world\"/><joint name=\"world_mount\" type=\"floating\"><parent "
            "link=\"world\"/><child link=\"trunk\"/><origin xyz=\"0 0 " +
                std::string(z) + "\"/></joint><link name=\"trunk\">");
    EXPECT_EQ(foot_of(import(), 0), "left_foot") << z;
    EXPECT_THAT(lines_, testing::Not(Contains(HasSubstr("no two legs")))) << z;
  }
}

// Of a robot that is upside down in its root's frame, arms that point ahead hang along another
// axis, as legs do.
TEST_F(ImportedStructure, StandsOnTheLongestLimbsWhereTheRootsFrameIsTurned) {
  for (const std::string side : {"left", "right"}) {
    replace("<joint name=\"" + side + "_shoulder_pitch\"", "<origin ",
            "<origin rpy=\"0 -1.57079632679 0\" ");
  }
  move_root("rpy=\"3.14159265358979 0 0\"");
  EXPECT_EQ(foot_of(import(), 0), "left_foot");
}

TEST_F(ImportedStructure, StandsWithoutShapesOfTheFeet) {
  remove_shape("left_foot");
  remove_shape("right_foot");
  const RobotModel model = import();
  EXPECT_THAT(lines_, Contains(HasSubstr("a rectangle is assumed as its sole")));
  EXPECT_TRUE(stands(model));
}

TEST_F(ImportedStructure, HasOneOutlineForBothFeet) {
  const Eigen::Vector2d size = size_of(import().left_sole_outline());
  remove_shape("left_foot");
  const RobotModel model = import();
  EXPECT_THAT(lines_, Contains(HasSubstr("its sole is unlike that of the other foot")));
  EXPECT_NEAR((size_of(model.left_sole_outline()) - size).norm(), 0, 1e-6);
}

TEST_F(ImportedStructure, HasASoleOfAllShapesThatAreFixedToTheFoot) {
  // Heel and toe of frames below the foot, and a row of corners in one line.
  for (const std::string side : {"left", "right"}) {
    const std::string foot = side + "_foot";
    std::string parts;
    for (int i = 0; i < 5; ++i) {
      const std::string name = side + "_part" + std::to_string(i);
      parts +=
          "<link name=\"" + name +
          "\"><collision><geometry><box size=\"0.01 0.06 0.01\"/></geometry></collision></link>"
          "<joint name=\"" +
          name + "_mount\" type=\"fixed\"><parent link=\"" + foot + "\"/><child link=\"" + name +
          "\"/><origin xyz=\"" + std::to_string(-0.1 + 0.06 * i) + " 0 -0.045\"/></joint>";
    }
    replace("</robot>", "</robot>", parts + "</robot>");
    remove_shape(foot);
  }
  const RobotModel model = import();
  EXPECT_NEAR(size_of(model.left_sole_outline()).x(), 0.25, 1e-6);
  EXPECT_EQ(model.left_sole_outline().size(), 4u);
}

// Any point of a roll axis may be the joint's origin, here one far behind the foot.
TEST_F(ImportedStructure, HasTheSolesFrameWithinTheSole) {
  replace("name=\"left_ankle_roll\"", "xyz=\"0 0 ", "xyz=\"-0.2 0 ");
  replace("name=\"right_ankle_roll\"", "xyz=\"0 0 ", "xyz=\"-0.2 0 ");
  const RobotModel model = import();
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : model.left_sole_outline()) box.extend(corner);
  EXPECT_LT(box.min().x(), -0.1 * box.sizes().x());
  EXPECT_GT(box.max().x(), 0.1 * box.sizes().x());
}

TEST_F(ImportedStructure, HasALevelSoleWhereTheFootIsNotLevelAtTheAnglesZero) {
  for (const std::string side : {"left", "right"}) {
    replace("name=\"" + side + "_ankle_pitch\"", "<origin xyz", "<origin rpy=\"0 0.2 0\" xyz");
  }
  const RobotModel model = import();
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0));
  EXPECT_NEAR(poses[model.left_sole()].linear()(0, 2), std::sin(0.2), 0.02);
  const auto ready = model.link_poses(model.ready_posture().position);
  EXPECT_NEAR(ready[model.left_sole()].linear()(2, 2), 1, 1e-3);
  EXPECT_TRUE(stands(model));
}

TEST_F(ImportedStructure, StandsWithKneesBentOnLegsOfFiveJoints) {
  for (const std::string side : {"left", "right"}) {
    replace("name=\"" + side + "_ankle_roll\"", "type=\"revolute\"", "type=\"fixed\"");
  }
  const RobotModel model = import();
  EXPECT_GT(model.ready_posture().position[model.find_motor("left_knee")], 0.2);
  EXPECT_TRUE(stands(model));
}

TEST_F(ImportedStructure, StandsWithTheFeetAsFarApartAsAsked) {
  RobotModel model = import();
  const auto distance_in = [](const RobotModel& robot, const std::vector<double>& position) {
    Kinematics kinematics(robot);
    kinematics.update(position);
    return (kinematics.left_sole().translation() - kinematics.right_sole().translation()).norm();
  };
  const double straight = distance_in(model, std::vector<double>(model.num_motors(), 0.0));
  write_text(robot() / "postures.yaml", make_postures_text(model, findings_, 0.8));
  model = RobotModel::load(robot());
  EXPECT_NEAR(distance_in(model, model.find_posture("ready")->position), 0.8 * straight, 1e-4);
  EXPECT_THAT(make_gait_text(model, {.foot_distance = 0.8}),
              HasSubstr(fmt::format("foot_separation: {{value: {:.4g},", 0.8 * straight)));
}

TEST_F(ImportedStructure, StandsOnAPlateWithoutLegs) {
  for (const std::string side : {"left", "right"}) {
    for (const char* joint :
         {"hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll"}) {
      replace("name=\"" + side + "_" + joint + "\"", "type=\"revolute\"", "type=\"fixed\"");
    }
  }
  const RobotModel model = import();
  EXPECT_EQ(model.num_motors(), 6);
  EXPECT_EQ(model.arms().size(), 2u);
  EXPECT_EQ(model.walk_limits().forward, 0);
  EXPECT_THAT(lines_, Contains(HasSubstr("no two legs")));
  EXPECT_TRUE(stands(model));
}

TEST_F(ImportedStructure, StandsOnAssumedPlatesWhereTheFeetArePoints) {
  TestBiped dimensions;
  dimensions.hip = "xy";
  dimensions.ankle = "";
  urdf_ = make_biped_urdf(dimensions);
  for (const char* side : {"left", "right"}) {
    const size_t at =
        urdf_.find("<box", urdf_.find("<link name=\"" + std::string(side) + "_foot\""));
    urdf_.replace(at, urdf_.find("/>", at) + 2 - at, "<sphere radius=\"0.01\"/>");
  }
  const RobotModel model = import();
  EXPECT_THAT(lines_, Contains(HasSubstr("left_shank: the feet are points that no joint pitches")));
  EXPECT_GT(size_of(model.left_sole_outline()).x(), 0.08);
  EXPECT_TRUE(stands(model));
  // The app shows no walk.
  EXPECT_EQ(model.walk_limits().forward, 0);
  EXPECT_FALSE(std::filesystem::exists(robot() / "gait.yaml"));
}

TEST_F(ImportedStructure, OpensAHandByOneMotor) {
  std::string fingers;
  for (const std::string side : {"left", "right"}) {
    for (int finger = 0; finger < 3; ++finger) {
      const std::string name = side + "_finger_" + std::to_string(finger);
      fingers += biped::joint(name, side + "_hand", name + "_link",
                              {0, (side == "left" ? 0.01 : -0.01) * finger, 0}, 'y',
                              finger == 0 ? -0.2 : 0, finger == 0 ? 1 : 1.5, 1) +
                 biped::link(name + "_link", 0.01, -0.01, 0.02) +
                 biped::joint(name + "_tip", name + "_link", name + "_tip_link", {0, 0, -0.03}, 'y',
                              0, 1, 1) +
                 biped::link(name + "_tip_link", 0.01, -0.01, 0.02);
    }
  }
  urdf_.insert(urdf_.rfind("</robot>"), fingers);
  // A tip that follows its finger in the file follows the motor of the hand.
  replace("joint name=\"left_finger_2_tip\"", "</joint>",
          "<mimic joint=\"left_finger_2\" multiplier=\"0.5\" offset=\"0.1\"/></joint>");
  const RobotModel model = import();
  EXPECT_EQ(model.num_motors(), 12 + 6 + 2);
  const Joint& tip = model.joints()[model.find_joint("left_finger_2_tip")];
  EXPECT_EQ(tip.mimic_joint, model.find_joint("left_finger_0"));
  // Finger 2 turns 1.5 rad while the first turns 1.
  EXPECT_NEAR(tip.mimic_multiplier, 0.75, 1e-9);
  EXPECT_NEAR(tip.mimic_offset, 0.1, 1e-9);
  const auto& groups = model.joint_groups();
  const auto hand = std::find_if(groups.begin(), groups.end(),
                                 [](const JointGroup& group) { return group.name == "left hand"; });
  ASSERT_NE(hand, groups.end());
  EXPECT_EQ(hand->pitch_motor, model.find_motor("left_finger_0"));
  EXPECT_THAT(lines_, Contains(HasSubstr("left_finger_1: is one of a hand's fingers; it follows "
                                         "left_finger_0")));
  EXPECT_TRUE(stands(model));
}

TEST_F(ImportedStructure, GroupsEachJointOnce) {
  TestBiped dimensions;
  dimensions.has_waist = true;
  urdf_ = make_biped_urdf(dimensions);
  const RobotModel model = import();
  std::vector<int> motors;
  for (const JointGroup& group : model.joint_groups()) {
    for (const int motor : {group.yaw_motor, group.pitch_motor, group.roll_motor}) {
      if (motor >= 0) motors.push_back(motor);
    }
    EXPECT_EQ(group.name == "waist", group.yaw_motor == model.find_motor("waist")) << group.name;
  }
  std::sort(motors.begin(), motors.end());
  std::vector<int> all(model.num_motors());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(motors, all);
}

}  // namespace
}  // namespace nao
