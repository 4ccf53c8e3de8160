#include "robot_model/robot_lights.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "common/data_path.h"
#include "common/yaml_entry.h"
#include "test/libs/robot_model/copied_robot.h"

namespace nao {
namespace {

TEST(RobotLights, OfTheNaoAreThoseOfItsInterfaceInTheSameOrder) {
  const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  std::vector<std::string> expected;
  const YamlEntry lola = YamlEntry::load(model.folder() / "lola.yaml");
  for (const auto& [name, key] : lola.at("lights").entries()) expected.push_back(name);
  const std::vector<RobotLight> lights = load_robot_lights(model);
  EXPECT_EQ(names_of(lights), expected);
  int num_eyes = 0;
  for (const RobotLight& light : lights) {
    num_eyes += light.is_eye ? 1 : 0;
    EXPECT_FALSE(light.discs.empty()) << light.name;
    for (const RobotLight::Disc& disc : light.discs) {
      EXPECT_NEAR(disc.normal.norm(), 1, 1e-9);
      // On the body: the head's radius is the largest distance from a link's origin.
      EXPECT_LT(disc.center.norm(), 0.13) << light.name;
    }
  }
  EXPECT_EQ(num_eyes, 2);
}

TEST(RobotLights, AreLeftOutWhereTheirFileIsDamaged) {
  const CopiedRobot robot;
  for (const char* damaged : {"lights: [", "lights: 3", "light: []", "lights: [{name: chest}]"}) {
    robot.write("lights.yaml", damaged);
    EXPECT_TRUE(load_robot_lights(RobotModel::load(robot.path())).empty()) << damaged;
  }
}

TEST(RobotLights, LeftOnesAreTheMirrorImagesOfRightOnes) {
  const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  const std::vector<RobotLight> lights = load_robot_lights(model);
  for (const RobotLight& left : lights) {
    if (!left.name.starts_with("left-")) continue;
    const std::string name = "right-" + left.name.substr(5);
    const auto right = std::find_if(lights.begin(), lights.end(),
                                    [&](const RobotLight& light) { return light.name == name; });
    ASSERT_NE(right, lights.end()) << name;
    const Eigen::Vector3d mirror(1, -1, 1);
    EXPECT_TRUE(left.discs[0].center.cwiseProduct(mirror).isApprox(right->discs[0].center));
    EXPECT_TRUE(left.discs[0].normal.cwiseProduct(mirror).isApprox(right->discs[0].normal));
  }
}

}  // namespace
}  // namespace nao
