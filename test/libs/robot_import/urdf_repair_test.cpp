// URDFs of any origin become files that RobotModel reads, or are refused with the reason.

#include "robot_import/urdf_repair.h"

#include <gmock/gmock.h>

#include <random>

#include "robot_import/mesh_import.h"
#include "test/libs/robot_import/imported_urdf.h"

namespace nao {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST_F(ImportedUrdf, WithoutMeshesIsReadAsItIs) {
  const RobotModel model = import();
  EXPECT_EQ(model.num_motors(), 12 + 6);
  EXPECT_THAT(lines_, testing::IsEmpty());
}

TEST_F(ImportedUrdf, GetsLimitsThatAreMissing) {
  const size_t at = urdf_.find("<limit", urdf_.find("name=\"left_elbow\""));
  urdf_.erase(at, urdf_.find("/>", at) + 2 - at);
  const RobotModel model = import();
  EXPECT_NEAR(model.motor_joint(model.find_motor("left_elbow")).upper, 3.14, 1e-9);
  EXPECT_THAT(lines_,
              Contains(testing::AllOf(HasSubstr("biped.urdf:"), HasSubstr("joint left_elbow"),
                                      HasSubstr("range"), HasSubstr("<limit lower="))));
}

TEST_F(ImportedUrdf, HoldsAJointThatSlidesAndTurnsOneWithoutEnd) {
  replace("name=\"left_elbow\"", "revolute", "prismatic");
  replace("name=\"right_elbow\"", "revolute", "continuous");
  const RobotModel model = import();
  EXPECT_LT(model.find_motor("left_elbow"), 0);
  EXPECT_GE(model.find_motor("right_elbow"), 0);
  EXPECT_THAT(lines_, Contains(HasSubstr("is prismatic; it is held")));
  EXPECT_THAT(lines_, Contains(HasSubstr("is continuous")));
}

TEST_F(ImportedUrdf, GetsAnInertiaInThePlaceOfAnImpossibleOne) {
  const size_t at = urdf_.find("izz=\"", urdf_.find("name=\"left_shank\""));
  urdf_.insert(at + 5, "9");
  const RobotModel model = import();
  EXPECT_THAT(lines_, Contains(testing::AllOf(HasSubstr("link left_shank"), HasSubstr("inertia"))));
  EXPECT_GT(model.links()[model.find_link("left_shank")].inertia.trace(), 0);
}

TEST_F(ImportedUrdf, MayHaveALinkOfNegativeMassAsAFrame) {
  replace("name=\"left_ankle\"", "<mass value=\"", "<mass value=\"-");
  const RobotModel model = import();
  EXPECT_EQ(model.links()[model.find_link("left_ankle")].mass, 0);
}

TEST_F(ImportedUrdf, MayHaveARootWithoutMass) {
  replace("<link name=\"trunk\">", "<link name=\"trunk\">",
          "<link name=\"base\"/><joint name=\"base_mount\" type=\"fixed\"><parent link=\"base\"/>"
          "<child link=\"trunk\"/></joint><link name=\"trunk\">");
  EXPECT_EQ(import().links().front().name, "base");
}

TEST_F(ImportedUrdf, FindsMeshesOfAPackageAndScalesThem) {
  std::filesystem::create_directories(source() / "meshes");
  // A tetrahedron of 100 mm.
  write_text(source() / "meshes" / "part.obj",
             "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const std::string mesh =
      "<geometry><mesh filename=\"package://biped_description/meshes/part.obj\" "
      "scale=\"0.001 0.001 0.001\"/></geometry>";
  replace("<link name=\"trunk\">", "<link name=\"trunk\">",
          "<link name=\"trunk\"><visual>" + mesh + "</visual><collision>" + mesh + "</collision>");
  const RobotModel model = import();
  const Link& trunk = model.links().front();
  ASSERT_EQ(trunk.visuals.size(), 1u);
  const auto points = read_mesh_points(trunk.visuals[0].mesh, Eigen::Vector3d::Ones());
  double greatest = 0;
  for (const Eigen::Vector3d& point : points) greatest = std::max(greatest, point.maxCoeff());
  EXPECT_NEAR(greatest, 0.1, 1e-6);
  ASSERT_EQ(trunk.collisions.size(), 1u);
  EXPECT_EQ(trunk.collisions[0].kind, Shape::Kind::kBox);
  EXPECT_NEAR(trunk.collisions[0].size.x(), 0.1, 1e-6);
  EXPECT_THAT(lines_, Contains(HasSubstr("a box about it takes its place")));
}

TEST_F(ImportedUrdf, CollidesByCapsulesInThePlaceOfCylinders) {
  const std::string tail = "\"/></geometry></collision>";
  replace("<link name=\"trunk\">", "<link name=\"trunk\">",
          "<link name=\"trunk\"><collision name=\"long\"><geometry><cylinder radius=\"0.02\" "
          "length=\"0.1" +
              tail + "<collision name=\"flat\"><geometry><cylinder radius=\"0.1\" length=\"0.05" +
              tail);
  const RobotModel model = import();
  const auto& shapes = model.links().front().collisions;
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].kind, Shape::Kind::kCapsule);
  EXPECT_NEAR(shapes[0].length, 0.06, 1e-9);
  EXPECT_EQ(shapes[1].kind, Shape::Kind::kBox);
  EXPECT_NEAR(shapes[1].size.z(), 0.05, 1e-9);
}

TEST_F(ImportedUrdf, SaysWhichMeshIsMissing) {
  replace(
      "<link name=\"trunk\">", "<link name=\"trunk\">",
      "<link name=\"trunk\"><visual><geometry><mesh filename=\"package://x/none.stl\"/></geometry>"
      "</visual>");
  import();
  EXPECT_THAT(lines_,
              Contains(testing::AllOf(HasSubstr("none.stl"), HasSubstr("put the file there"))));
}

TEST_F(ImportedUrdf, IsRefusedWithLineAndRemedy) {
  urdf_ = "<robot name=\"x\">\n<xacro:macro/>\n</robot>";
  EXPECT_THAT(error_of_import(), HasSubstr("run `xacro"));
  urdf_ = "<robot name=\"x\">\n<link";
  EXPECT_THAT(error_of_import(), HasSubstr("biped.urdf:"));
  urdf_ = "<robot name=\"x\"><link name=\"a\"/><link name=\"b\"/></robot>";
  EXPECT_THAT(error_of_import(), HasSubstr("second root"));
  urdf_ = "<robot name=\"x\"><link name=\"a\"/></robot>";
  EXPECT_THAT(error_of_import(), HasSubstr("no link has a mass"));
  EXPECT_FALSE(std::filesystem::exists(robot())) << "nothing half done stays";
}

TEST_F(ImportedUrdf, NeverCrashesTheImportHoweverDamaged) {
  std::mt19937 random(20140614);
  const std::string whole = urdf_;
  const auto below = [&random](size_t count) {
    return std::uniform_int_distribution<size_t>(0, count - 1)(random);
  };
  const std::vector<std::string> words = {"nan", "-1",   "1e999", "0",     "\"",    "<",
                                          "/>",  "<!--", "mimic", "trunk", "fixed", "\xff"};
  int num_refused = 0;
  for (int variant = 0; variant < 300; ++variant) {
    urdf_ = whole;
    for (size_t i = 0; i < 1 + below(4); ++i) {
      const size_t at = below(urdf_.size());
      const size_t length = std::min(urdf_.size() - at, 1 + below(60));
      switch (below(3)) {
        case 0:
          urdf_.erase(at, length);
          break;
        case 1:
          urdf_.insert(below(urdf_.size()), urdf_.substr(at, length));
          break;
        default:
          urdf_.insert(at, words[below(words.size())]);
          break;
      }
    }
    num_refused += error_of_import().empty() ? 0 : 1;
  }
  EXPECT_GT(num_refused, 30);
}

}  // namespace
}  // namespace nao
