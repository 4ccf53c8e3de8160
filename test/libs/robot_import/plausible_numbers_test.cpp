// Numbers that no robot of this mass and size can have are replaced, and told.

#include <algorithm>
#include <regex>

#include "test/libs/robot_import/imported_urdf.h"

namespace nao {
namespace {

std::string with_all(const std::string& text, const std::string& attribute,
                     const std::string& value) {
  return std::regex_replace(text, std::regex(attribute + "=\"[^\"]*\""),
                            attribute + "=\"" + value + "\"");
}

TEST_F(ImportedUrdf, KeepsPlausibleNumbers) {
  import();
  EXPECT_THAT(lines_, testing::Not(testing::Contains(testing::HasSubstr("for a robot of"))));
  EXPECT_THAT(lines_, testing::Not(testing::Contains(testing::HasSubstr("gyration"))));
}

TEST_F(ImportedUrdf, ReplacesEffortsThatAreTooGreatOrOnePlaceholder) {
  const std::string original = urdf_;
  for (const char* effort : {"1000", "0.1"}) {
    urdf_ = with_all(original, "effort", effort);
    const RobotModel model = import();
    const double knee = model.motor_joint(model.find_motor("left_knee")).max_torque;
    // Weight at the length of the leg, about 0.45 m: N m.
    const double weight_torque = model.total_mass() * 9.81 * 0.45;
    EXPECT_GT(knee, 0.2 * weight_torque) << effort;
    EXPECT_LT(knee, weight_torque) << effort;
    EXPECT_THAT(lines_, testing::Contains(testing::HasSubstr("for a robot of"))) << effort;
  }
}

TEST_F(ImportedUrdf, ReplacesOneVelocityThatDoesNotSwingALeg) {
  urdf_ = with_all(urdf_, "velocity", "1");
  const RobotModel model = import();
  EXPECT_GT(model.motor_joint(0).max_velocity, 3);
}

TEST_F(ImportedUrdf, ReplacesAnInertiaThatIsLargerThanTheLink) {
  replace("<link name=\"left_foot\">", "ixx=\"", "ixx=\"1");
  replace("<link name=\"left_foot\">", "iyy=\"", "iyy=\"1");
  replace("<link name=\"left_foot\">", "izz=\"", "izz=\"1");
  // A link of which nothing is known but its mass.
  urdf_.insert(urdf_.rfind("</robot>"),
               "<link name=\"pad\"><inertial><mass value=\"0.1\"/><inertia ixx=\"9\" iyy=\"9\" "
               "izz=\"9\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link><joint name=\"pad\" "
               "type=\"fixed\"><parent link=\"trunk\"/><child link=\"pad\"/></joint>");
  const RobotModel model = import();
  EXPECT_LT(model.links()[model.find_link("pad")].inertia.maxCoeff(), 0.1);
  EXPECT_LT(model.links()[model.find_link("left_foot")].inertia.maxCoeff(), 0.1);
  EXPECT_THAT(lines_, testing::Contains(testing::HasSubstr("radius of gyration")));
}

class ImportedLegs : public ImportedUrdf {
 protected:
  void set(const std::string& joint, const std::string& attribute, const std::string& value) {
    const size_t at = urdf_.find(attribute + "=\"", urdf_.find("joint name=\"" + joint + "\"")) +
                      attribute.size() + 2;
    urdf_.replace(at, urdf_.find('"', at) - at, value);
  }
  bool says(const std::string& words) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const std::string& line) {
      return line.find(words) != std::string::npos;
    });
  }
};

TEST_F(ImportedLegs, HaveTheGreaterOfTwoUnlikeEfforts) {
  set("left_ankle_pitch", "effort", "1.5");
  const RobotModel model = import();
  EXPECT_EQ(model.motor_joint(model.find_motor("left_ankle_pitch")).max_torque,
            model.motor_joint(model.find_motor("right_ankle_pitch")).max_torque);
  EXPECT_TRUE(says("left_ankle_pitch: has an effort of 1.5 N m, its mirror image one of"));
}

TEST_F(ImportedLegs, HaveNoEffortsOfMotorsBeforeTheirGears) {
  urdf_ = std::regex_replace(urdf_, std::regex("effort=\"([0-9])[^\"]*\""), "effort=\"0.$1\"");
  const RobotModel model = import();
  EXPECT_GT(model.motor_joint(model.find_motor("left_hip_pitch")).max_torque, 10);
  EXPECT_TRUE(says("of motors before their gears"));
}

TEST_F(ImportedLegs, AndWaistHoldWhatTheyCarry) {
  // A backpack behind a waist, and a waist that is weak; knees that cannot hold a stance.
  TestBiped dimensions;
  urdf_ = make_biped_urdf(dimensions);
  replace("<robot name=\"biped\">", "<robot name=\"biped\">",
          "<robot name=\"biped\"><link name=\"pelvis\"><inertial><mass value=\"1\"/><inertia "
          "ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>"
          "</link><joint name=\"waist_pitch\" type=\"revolute\"><parent link=\"pelvis\"/><child "
          "link=\"trunk\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" effort=\"0.5\" "
          "velocity=\"9\"/></joint>");
  urdf_ =
      std::regex_replace(urdf_, std::regex("parent link=\"trunk\"/><child link=\"(left|right)_hip"),
                         "parent link=\"pelvis\"/><child link=\"$1_hip");
  set("left_knee", "effort", "1");
  set("right_knee", "effort", "1");
  const RobotModel model = import();
  EXPECT_TRUE(says("waist_pitch: has an effort of 0.5 N m, too small for the"));
  EXPECT_TRUE(says("left_knee: has an effort of 1 N m, and standing takes"));
  EXPECT_GT(model.motor_joint(model.find_motor("left_knee")).max_torque, 1.5);
}

TEST_F(ImportedLegs, GetRangesThatAllowAStance) {
  // Those of a knee at both ankles, and of a hip at one knee.
  set("left_ankle_pitch", "lower", "0");
  set("right_ankle_pitch", "lower", "0");
  set("left_knee", "lower", "-2");
  set("left_knee", "upper", "1");
  const RobotModel model = import();
  EXPECT_TRUE(says("exclude a stance with level soles"));
  EXPECT_EQ(model.motor_joint(model.find_motor("left_ankle_pitch")).lower, -1);
  EXPECT_EQ(model.motor_joint(model.find_motor("left_knee")).lower, 0);
  EXPECT_GT(model.find_posture("ready")->position[model.find_motor("left_knee")], 0.1);
  EXPECT_FALSE(says("do not reach it"));
}

}  // namespace
}  // namespace nao
