// Numbers that no robot of this mass and size can have are replaced, and told.

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

}  // namespace
}  // namespace nao
