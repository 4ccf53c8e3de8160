// URDFs of any origin become files that RobotModel reads, or are refused with the reason.

#include "robot_import/urdf_repair.h"

#include <gmock/gmock.h>

#include <random>
#include <regex>

#include "common/text_file.h"
#include "rendering/mesh_file.h"
#include "robot_import/mesh_import.h"
#include "sim/tree.h"
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
  replace("name=\"right_elbow\"", "lower=\"-2\"", "lower=\"-1e16\"");
  replace("name=\"left_knee\"", "revolute", "continuous");
  const RobotModel model = import();
  // A range that a file states although the type says that there is none.
  EXPECT_EQ(model.motor_joint(model.find_motor("left_knee")).lower, 0);
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

TEST_F(ImportedUrdf, MayHaveALinkOfNegativeMass) {
  replace("name=\"left_ankle\"", "<mass value=\"", "<mass value=\"-");
  const RobotModel model = import();
  EXPECT_THAT(lines_, Contains(HasSubstr("link left_ankle: has no mass above 0")));
  EXPECT_GT(model.links()[model.find_link("left_ankle")].mass, 0);
}

TEST_F(ImportedUrdf, MayHaveARootWithoutMass) {
  replace("<link name=\"trunk\">", "<link name=\"trunk\">",
          "<link name=\"base\"/><joint name=\"base_mount\" type=\"fixed\"><parent link=\"base\"/>"
          "<child link=\"trunk\"/></joint><link name=\"trunk\">");
  EXPECT_EQ(import().links().front().name, "base");
}

TEST_F(ImportedUrdf, LeavesOutAMeshThatCannotBeReadAndNamesIt) {
  write_text(source() / "broken.stl", "no mesh");
  add_to_link("trunk",
              "<collision><geometry><mesh filename=\"broken.stl\"/></geometry></collision>");
  import();
  EXPECT_THAT(lines_, Contains(AllOf(HasSubstr("broken.stl"), HasSubstr("is not a mesh"))));
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

/** A plate of n x n squares, 1 m wide, in OBJ, with hills of a height, m. */
std::string make_plate(int n, double height) {
  std::ostringstream text;
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k <= n; ++k) {
      text << "v " << 1.0 * i / n << ' ' << 1.0 * k / n << ' ' << (i + k) % 2 * height << '\n';
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 1; k <= n; ++k) {
      const int corner = i * (n + 1) + k;
      text << "f " << corner << ' ' << corner + n + 1 << ' ' << corner + n + 2 << ' ' << corner + 1
           << '\n';
    }
  }
  return text.str();
}

TEST_F(ImportedUrdf, HasMeshesOfFewBytesEachOnlyOnce) {
  write_text(source() / "flat.obj", make_plate(50, 0));
  write_text(source() / "rough.obj", make_plate(400, 0.003));
  const auto visual = [](const std::string& file) {
    return "<visual><geometry><mesh filename=\"" + file + "\"/></geometry></visual>";
  };
  add_to_link("trunk", visual("flat.obj") + visual("flat.obj"));
  EXPECT_EQ(import().links().front().visuals.size(), 2u);
  const std::filesystem::path flat = robot() / "meshes" / "0_flat.glb";
  // The other one is that of both feet.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(flat.parent_path()), {}), 2);
  // Of two triangles, which share two of their four corners.
  EXPECT_THAT(read_file(flat), HasSubstr("\"count\":4,"));

  // 320,000 triangles with hills that are higher than the finest error.
  add_to_link("trunk", visual("rough.obj"));
  import();
  uintmax_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(flat.parent_path())) {
    bytes += file.file_size();
  }
  EXPECT_LE(bytes, 5'000'000u);
}

TEST_F(ImportedUrdf, KeepsTheOutsideOfAMirroredMesh) {
  write_text(source() / "part.obj",
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  add_to_link(
      "trunk",
      "<visual><geometry><mesh filename=\"part.obj\" scale=\"1 -1 1\"/></geometry></visual>");
  const RobotModel model = import();
  const Mesh mesh = load_mesh(model.links().front().visuals.at(0).mesh);
  // Signed volume of a closed surface: positive where its corners run counter-clockwise from
  // outside.
  float volume = 0;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto corner = [&](size_t k) { return mesh.vertices[mesh.indices[i + k]].position; };
    volume += corner(0).dot(corner(1).cross(corner(2))) / 6;
    EXPECT_GT(mesh.vertices[mesh.indices[i]].normal.dot(corner(0) + corner(1) + corner(2) -
                                                        3 * Eigen::Vector3f(0.2f, -0.2f, 0.2f)),
              0);
  }
  EXPECT_NEAR(volume, 1.0 / 6, 1e-6);
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

// What other programs write into URDFs, and Drake, Pinocchio, MuJoCo, RViz or PyBullet read.
TEST_F(ImportedUrdf, MayHaveElementsOfOtherPrograms) {
  replace("<link name=\"trunk\">", "<link name=\"trunk\">",
          "<!-- made by <xacro:macro> from ${file} -->\n<drake:frame name=\"f\"/><drake:frame "
          "name=\"g\"/>\n<gazebo><plugin file=\"${x}\"/></gazebo><xacro:camera name=\"c\"/>"
          "<link name=\"trunk\"><self_collision_checking/>"
          "<visual><geometry><box size=\"1 1 1\"/><drake:declare_convex/></geometry>"
          "<material/></visual>"
          "<visual><geometry><box size=\"1 1 1\"/></geometry>"
          "<material name=\"grey\"><color rgba=\"x\"/></material></visual>");
  EXPECT_EQ(import().links().front().visuals.size(), 2u);
  EXPECT_THAT(lines_, Contains(HasSubstr("<drake:frame> is not part of a URDF (2 times)")));
  EXPECT_THAT(lines_, Contains(HasSubstr("<xacro:camera> is not expanded")));
}

TEST_F(ImportedUrdf, IsRefusedWithANumberThatXacroDidNotExpand) {
  replace("name=\"left_elbow\"", "<limit lower=\"", "<limit lower=\"${-pi}\" old=\"");
  EXPECT_THAT(error_of_import(), HasSubstr("run `xacro"));
}

TEST_F(ImportedUrdf, ReadsCapsulesAndLeavesOutShapesWithoutSize) {
  const auto shape = [](const std::string& form) {
    return "<collision><geometry>" + form + "</geometry></collision>";
  };
  add_to_link("trunk", shape("<capsule radius=\"0.02\" length=\"0.1\"/>") +
                           shape("<sphere radius=\"0\"/>") + shape("<box size=\"1 1\"/>") +
                           shape("<cylinder radius=\"-1\" length=\"1\"/>"));
  const RobotModel model = import();
  const auto& shapes = model.links().front().collisions;
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0].kind, Shape::Kind::kCapsule);
  EXPECT_NEAR(shapes[0].length, 0.1, 1e-12);
  EXPECT_THAT(lines_, Contains(HasSubstr("link trunk: a sphere has no size above 0")));
}

TEST_F(ImportedUrdf, ReplacesNumbersThatCannotBeRead) {
  replace("name=\"left_elbow\"", "<origin xyz=\"", "<origin rpy=\"0 0\" xyz=\"");
  replace("name=\"right_elbow\"", "lower=\"-2\"", "lower=\"2\"");
  const RobotModel model = import();
  EXPECT_NEAR(model.motor_joint(model.find_motor("right_elbow")).lower, 0.1, 1e-12);
  EXPECT_THAT(lines_, Contains(HasSubstr("joint left_elbow: rpy=\"0 0\" is not")));
  EXPECT_THAT(lines_, Contains(HasSubstr("lower limit above the upper one")));
}

class ImportedMimics : public ImportedUrdf {
 protected:
  /** Makes a joint follow another one. */
  void couple(const std::string& joint, const std::string& leader, const std::string& numbers) {
    replace("name=\"" + joint + "\"", "</joint>",
            "<mimic joint=\"" + leader + "\" " + numbers + "/></joint>");
  }
};

TEST_F(ImportedMimics, FollowTheMotorThatAMimicFollows) {
  // Both hips' first joints and the left shoulder are carried by the trunk.
  couple("right_hip_yaw", "left_hip_yaw", "multiplier=\"-0.5\" offset=\"0.1\"");
  couple("left_shoulder_pitch", "right_hip_yaw", "multiplier=\"2\" offset=\"0.3\"");
  const RobotModel model = import();
  const Joint& shoulder = model.joints()[model.find_joint("left_shoulder_pitch")];
  EXPECT_EQ(shoulder.mimic_joint, model.find_joint("left_hip_yaw"));
  EXPECT_NEAR(shoulder.mimic_multiplier, -1, 1e-12);
  EXPECT_NEAR(shoulder.mimic_offset, 0.5, 1e-12);
}

TEST_F(ImportedMimics, FollowJointsOfOtherBodiesAndAreHeldWhereNoMotorLeads) {
  couple("left_elbow", "left_shoulder_roll", "multiplier=\"1\" offset=\"-0.4\"");
  couple("right_elbow", "nothing", "");
  couple("right_shoulder_roll", "left_sole_mount", "offset=\"-0.3\"");
  const RobotModel model = import();
  const Joint& elbow = model.joints()[model.find_joint("left_elbow")];
  EXPECT_EQ(elbow.mimic_joint, model.find_joint("left_shoulder_roll"));
  EXPECT_LT(model.find_motor("left_elbow"), 0);
  EXPECT_THAT(lines_, Contains(HasSubstr("mimics \"nothing\"")));
  EXPECT_THAT(lines_, Contains(HasSubstr("mimics left_sole_mount, which is fixed; it is held at "
                                         "-0.3")));
  const Joint& held = model.joints()[model.find_joint("right_shoulder_roll")];
  EXPECT_NEAR(Eigen::AngleAxisd(held.pose_in_parent.linear()).angle(), 0.3, 1e-9);
  // The physics takes it.
  EXPECT_NO_THROW(sim::Tree{model});
}

TEST_F(ImportedMimics, OfEachOtherAreHeld) {
  couple("left_elbow", "right_elbow", "");
  couple("right_elbow", "left_elbow", "");
  EXPECT_LT(import().find_motor("left_elbow"), 0);
}

TEST_F(ImportedUrdf, GetsALittleMassBetweenMovingLinks) {
  const size_t at = urdf_.find("<inertial>", urdf_.find("<link name=\"left_ankle\""));
  urdf_.erase(at, urdf_.find("</inertial>", at) + 11 - at);
  const RobotModel model = import();
  EXPECT_GT(model.links()[model.find_link("left_ankle")].mass, 0);
  EXPECT_THAT(lines_, Contains(HasSubstr("link left_ankle: is moved by a joint, but has no mass")));
  EXPECT_NO_THROW(sim::Tree{model});
}

TEST_F(ImportedUrdf, HoldsWhatHasNoMassAndJointsAboveTheRobot) {
  replace("<link name=\"trunk\">", "<link name=\"trunk\">",
          "<link name=\"world\"/><joint name=\"free\" type=\"continuous\"><parent link=\"world\"/>"
          "<child link=\"trunk\"/></joint><link name=\"horn\"/><joint name=\"horn_yaw\" "
          "type=\"continuous\"><parent link=\"trunk\"/><child link=\"horn\"/></joint>"
          "<link name=\"trunk\">");
  const RobotModel model = import();
  EXPECT_LT(model.find_motor("free"), 0);
  EXPECT_LT(model.find_motor("horn_yaw"), 0);
  EXPECT_EQ(model.num_motors(), 12 + 6);
}

TEST_F(ImportedUrdf, FindsMeshesWhateverTheCaseOfTheirLetters) {
  std::filesystem::create_directories(source() / "meshes");
  // Collada: with z up it has the axes of the link.
  write_text(
      source() / "meshes" / "Part.dae",
      "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>"
      "<up_axis>Z_UP</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source "
      "id=\"p\">"
      "<float_array id=\"a\" count=\"12\">0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common>"
      "<accessor source=\"#a\" count=\"4\" stride=\"3\"><param name=\"X\" type=\"float\"/><param "
      "name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common>"
      "</source><vertices id=\"v\"><input semantic=\"POSITION\" "
      "source=\"#p\"/></vertices><triangles "
      "count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 2 1 0 1 3 0 3 2 1 2 "
      "3</p></triangles></mesh></geometry></"
      "library_geometries><library_visual_scenes><visual_scene "
      "id=\"s\"><node><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
      "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
  add_to_link("trunk",
              "<collision><geometry><mesh filename=\"package://x/Meshes\\part.DAE\"/></geometry>"
              "</collision>");
  const RobotModel model = import();
  ASSERT_EQ(model.links().front().collisions.size(), 1u);
  const Eigen::Vector3d size = model.links().front().collisions[0].size;
  EXPECT_TRUE(size.isApprox(Eigen::Vector3d(1, 2, 3), 1e-6)) << size.transpose();
}

TEST_F(ImportedUrdf, IsRefusedIfItIsNestedTooDeep) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  add_to_link("trunk", deep);
  EXPECT_THAT(error_of_import(), HasSubstr("nested"));
}

TEST_F(ImportedUrdf, HasPosturesWithinLimitsOfManyDigits) {
  replace("name=\"left_shoulder_roll\"", "lower=\"-0.29999999999999999\"",
          "lower=\"0.095993108859688167\"");
  EXPECT_GT(import().motor_joint(0).upper, 0);
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

TEST_F(ImportedUrdf, IsTheLargestTreeWithoutLoopsAndUnknownJoints) {
  replace("</robot>", "</robot>",
          "<link name=\"ball\"><inertial><mass value=\"0.1\"/></inertial></link><link "
          "name=\"spot\"/><joint name=\"spot\" type=\"fixed\"><parent link=\"ball\"/><child "
          "link=\"spot\"/></joint><joint name=\"bar\" type=\"revolute\"><parent "
          "link=\"left_hand\"/><child link=\"right_hand\"/></joint></robot>");
  replace("name=\"left_elbow\"", "revolute", "ball");
  replace("<robot name=\"biped\"", "name=\"biped\"", "version=\"2.0\"");
  const RobotModel model = import();
  EXPECT_LT(model.find_link("ball"), 0);
  EXPECT_EQ(model.num_motors(), 12 + 5);
  EXPECT_THAT(lines_, Contains(HasSubstr("link ball: is a second root besides trunk")));
  EXPECT_THAT(lines_, Contains(HasSubstr("joint bar: closes a loop")));
  EXPECT_THAT(lines_, Contains(HasSubstr("left_elbow: has the unknown type \"ball\"")));
}

TEST_F(ImportedUrdf, GetsMassesWhereNoLinkHasOne) {
  urdf_ = std::regex_replace(urdf_, std::regex("<inertial>.*?</inertial>"), "");
  const RobotModel model = import();
  EXPECT_EQ(model.num_motors(), 12 + 6);
  EXPECT_NEAR(model.total_mass(), 1 + 12 + 6, 1e-9);
  EXPECT_THAT(lines_, Contains(HasSubstr("no link has a mass; 1 kg are assumed for each")));
}

TEST_F(ImportedUrdf, MayHaveNamesOfAnyLettersAndLength) {
  urdf_ =
      std::regex_replace(urdf_, std::regex("left_"), "\xe5\xb7\xa6&quot; [" + std::string(60, 'x'));
  urdf_ = std::regex_replace(urdf_, std::regex("right_"), "1: {#");
  EXPECT_EQ(import().num_motors(), 12 + 6);
}

TEST_F(ImportedUrdf, DrawsPrimitivesAsMeshesInTheirColors) {
  write_text(source() / "part.stl",
             "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
             "endloop\nendfacet\nendsolid x\n");
  add_to_link("trunk",
              "<visual><geometry><box size=\"0.1 0.2 0.3\"/></geometry><material name=\"red\"/>"
              "</visual><visual><geometry><mesh filename=\"part.stl\"/></geometry><material "
              "name=\"own\"><color rgba=\"0 1 0 1\"/></material></visual>");
  add_to_link("left_foot",
              "<visual><geometry><cylinder radius=\"0.1\" length=\"1\"/></geometry></visual>");
  replace("<link", "<link", "<material name=\"red\"><color rgba=\"1 0 0 1\"/></material><link");
  const RobotModel model = import();
  const auto mesh_of = [&](const std::string& link, size_t visual) {
    return load_mesh(model.links()[model.find_link(link)].visuals.at(visual).mesh);
  };
  const Mesh box = mesh_of("trunk", 0);
  EXPECT_NEAR(bounding_sphere(box).radius, 0.5 * std::sqrt(0.14), 1e-3);
  EXPECT_EQ(box.vertices.front().encoded_color, encode_color(Color(1, 0, 0, 1)));
  EXPECT_EQ(mesh_of("trunk", 1).vertices.front().encoded_color, encode_color(Color(0, 1, 0, 1)));
  EXPECT_GT(mesh_of("left_foot", 0).indices.size(), 100u);
}

TEST_F(ImportedUrdf, IsSeenByItsCollisionShapesWhereItHasNoVisual) {
  const auto is_seen = [](const RobotModel& model) {
    return !model.links()[model.find_link("right_foot")].visuals.empty();
  };
  EXPECT_FALSE(is_seen(import())) << "nothing is drawn: shells are made for it";
  add_to_link("trunk", "<visual><geometry><sphere radius=\"0.1\"/></geometry></visual>");
  EXPECT_TRUE(is_seen(import()));
}

TEST_F(ImportedUrdf, HasRangesAndRotationsInRadians) {
  const std::string whole = urdf_;
  // Not of one joint: what it means is not known.
  replace("name=\"left_elbow\"", "lower=\"-2\"", "lower=\"-90\"");
  RobotModel model = import();
  EXPECT_NEAR(model.motor_joint(model.find_motor("left_elbow")).lower, -3.14, 1e-9);
  EXPECT_THAT(lines_, Contains(HasSubstr("joint left_elbow: has a range of more than a turn")));

  urdf_ = whole;
  const RobotModel radians = import();
  std::string degrees;
  const std::regex limit("(lower|upper)=\"([^\"]+)\"");
  auto last = urdf_.cbegin();
  for (std::sregex_iterator match(urdf_.begin(), urdf_.end(), limit), end; match != end; ++match) {
    degrees.append(last, urdf_.cbegin() + match->position());
    degrees += match->str(1) + "=\"" + std::to_string(std::stod(match->str(2)) * 180 / M_PI) + "\"";
    last = urdf_.cbegin() + match->position() + match->length();
  }
  urdf_ = degrees.append(last, urdf_.cend());
  add_to_link("trunk",
              "<collision><origin rpy=\"0 0 90\"/><geometry><sphere radius=\"0.01\"/>"
              "</geometry></collision>");
  model = import();
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    EXPECT_NEAR(model.motor_joint(motor).upper, radians.motor_joint(motor).upper, 1e-5);
  }
  EXPECT_NEAR(model.links().front().collisions.front().pose_in_link.linear()(1, 0), 1, 1e-6);
  EXPECT_THAT(lines_, Contains(HasSubstr("the ranges are taken for degrees")));
  EXPECT_THAT(lines_, Contains(HasSubstr("rpy is more than a turn")));
}

/** Multiplies the numbers of all attributes of a name. */
std::string multiply(const std::string& text, const std::string& attribute, double factor) {
  std::string result;
  auto last = text.cbegin();
  const std::regex all("\\b" + attribute + "=\"([^\"]+)\"");
  for (std::sregex_iterator match(text.begin(), text.end(), all), end; match != end; ++match) {
    result.append(last, text.cbegin() + match->position());
    result += attribute + "=\"";
    std::istringstream numbers(match->str(1));
    for (double number = 0; numbers >> number;) result += std::to_string(number * factor) + " ";
    result += "\"";
    last = text.cbegin() + match->position() + match->length();
  }
  return result.append(last, text.cend());
}

TEST_F(ImportedUrdf, IsInMetresAndKilograms) {
  const RobotModel metres = import();
  for (const char* length : {"xyz", "size", "radius", "length"}) {
    urdf_ = multiply(urdf_, length, 1000);
  }
  // Axes have no unit.
  urdf_ = std::regex_replace(urdf_, std::regex("1000\\.000000"), "1");
  urdf_ = multiply(urdf_, "value", 1000);
  const RobotModel model = import();
  EXPECT_NEAR(model.total_mass(), metres.total_mass(), 1e-3);
  EXPECT_NEAR(model.references().heights.standing, metres.references().heights.standing, 1e-3);
  EXPECT_THAT(lines_, Contains(HasSubstr("the lengths are taken for millimetres")));
  EXPECT_THAT(lines_, Contains(HasSubstr("the masses are taken for grams")));
}

TEST_F(ImportedUrdf, FindsMeshesByOtherPathsAndInOtherUnits) {
  std::filesystem::create_directories(source() / "my meshes");
  write_text(source() / "my meshes" / "part.obj",
             "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  for (const std::string path :
       {"my meshes/part.obj", "package://a/my%20meshes/part.obj", "$(find a)/my meshes/part.obj",
        "file:///home/a/b/c/d/e/my meshes/part.obj", "C:\\a\\my meshes\\part.obj"}) {
    urdf_ = make_biped_urdf(TestBiped{});
    add_to_link("trunk",
                "<collision><geometry><mesh filename=\"" + path + "\"/></geometry></collision>");
    const RobotModel model = import();
    ASSERT_EQ(model.links().front().collisions.size(), 1u) << path;
    EXPECT_NEAR(model.links().front().collisions[0].size.x(), 0.1, 1e-6) << path;
    EXPECT_THAT(lines_, Contains(HasSubstr("is taken for one in millimetres"))) << path;
  }
}

TEST_F(ImportedUrdf, MayBeInOtherEncodings) {
  const std::string whole = urdf_;
  std::string wide = "\xff\xfe";
  for (const char letter : whole) wide += std::string(1, letter) + std::string(1, '\0');
  for (const std::string& text :
       {"\xef\xbb\xbf" + whole, wide, "[INFO] expanded\n" + whole,
        "<!DOCTYPE robot [<!ENTITY a \"b\">]>\n" + whole, whole + std::string(3, '\0')}) {
    urdf_ = text;
    EXPECT_EQ(import().num_motors(), 12 + 6);
  }
  // e with an acute accent, in ISO 8859-1.
  urdf_ = "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>" +
          std::regex_replace(whole, std::regex("left_elbow"), "\xe9");
  EXPECT_GE(import().find_motor("\xc3\xa9"), 0);
  EXPECT_THAT(lines_, Contains(HasSubstr("is not UTF-8; it is read as ISO-8859-1")));
  urdf_ = std::regex_replace(whole, std::regex("left_elbow"), "&#233;&apos;&quot;&lt;");
  EXPECT_GE(import().find_motor("\xc3\xa9'\"<"), 0);
}

TEST_F(ImportedUrdf, ReadsNumbersWithCommas) {
  replace("name=\"left_elbow\"", "lower=\"-2\"", "lower=\"-1,5\"");
  urdf_ = std::regex_replace(urdf_, std::regex("<axis xyz=\"(\\S+) (\\S+) (\\S+)\""),
                             "<axis xyz=\"$1, $2,$3\"");
  const RobotModel model = import();
  EXPECT_EQ(model.num_motors(), 12 + 6);
  EXPECT_EQ(model.motor_joint(model.find_motor("left_elbow")).lower, -1.5);
  EXPECT_THAT(lines_, Contains(HasSubstr("is not numbers with points and spaces")));
}

TEST_F(ImportedUrdf, MayHaveNamesTwiceAndJointsOfNoLink) {
  replace("<joint name=\"left_elbow\"", "left_elbow", "right_elbow");
  replace("<link", "<link",
          "<link name=\"left_foot\"/><joint name=\"none\" type=\"fixed\"><parent link=\"trunk\"/>"
          "<child link=\"no\"/></joint><link");
  EXPECT_EQ(import().num_motors(), 12 + 6);
  EXPECT_THAT(lines_, Contains(HasSubstr("it is called right_elbow_2")));
  EXPECT_THAT(lines_, Contains(HasSubstr("link left_foot: is a second one of this name")));
  EXPECT_THAT(lines_, Contains(HasSubstr("its child \"no\" is not a link")));
}

TEST_F(ImportedUrdf, IgnoresLimitsOfFixedJoints) {
  replace("</robot>", "</robot>",
          "<link name=\"frame\"/><joint name=\"mount\" type=\"fixed\"><parent link=\"trunk\"/>"
          "<child link=\"frame\"/><limit lower=\"nan\" upper=\"inf\"/></joint></robot>");
  EXPECT_EQ(import().num_motors(), 12 + 6);
}

TEST_F(ImportedUrdf, IsRefusedWithLineAndRemedy) {
  urdf_ = "<robot name=\"x\">\n<xacro:macro/>\n</robot>";
  EXPECT_THAT(error_of_import(), HasSubstr("run `xacro"));
  urdf_ = "<robot name=\"x\">\n<link";
  EXPECT_THAT(error_of_import(), HasSubstr("biped.urdf:"));
  urdf_ = "<robot/>";
  EXPECT_THAT(error_of_import(), HasSubstr("has no <link>"));
  urdf_ = "<robot name=\"x\"><link name=\"a\"/></robot>";
  EXPECT_THAT(error_of_import(), HasSubstr("no joint can move"));
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
