/** RobotModel::load() with invalid files. */

#include <gmock/gmock.h>

#include <array>
#include <clocale>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"
#include "test/libs/robot_model/copied_robot.h"
#include "test/support/decimal_comma.h"

namespace nao {
namespace {

namespace fs = std::filesystem;

TEST(RobotFiles, LoadAsTheyAre) {
  const CopiedRobot robot;
  EXPECT_EQ(error_of(robot.path()), "");
}

TEST(RobotFiles, HaveTheMeshesThatTheyName) {
  for (const fs::directory_entry& robot : fs::directory_iterator(data_path() / "robots")) {
    if (!fs::exists(robot.path() / "robot.yaml")) continue;
    const RobotModel model = RobotModel::load(robot.path());
    for (const Link& link : model.links()) {
      for (const Shape& shape : link.visuals) {
        if (shape.kind != Shape::Kind::kMesh) continue;
        EXPECT_TRUE(fs::is_regular_file(shape.mesh)) << link.name << ": " << shape.mesh;
      }
    }
  }
}

/** But for kicks, which have buttons of their own, and policies, which are shown by their names. */
TEST(RobotFiles, HaveTheirNamesInEachLanguageOfTheApp) {
  for (const fs::directory_entry& robot : fs::directory_iterator(data_path() / "robots")) {
    if (!fs::exists(robot.path() / "robot.yaml")) continue;
    const RobotModel model = RobotModel::load(robot.path());
    std::set<std::pair<std::string, std::string>> missing;
    for (const Posture& posture : model.postures()) missing.emplace("posture", posture.name);
    for (const JointGroup& group : model.joint_groups()) missing.emplace("group", group.name);
    for (const auto& camera : model.cameras()) missing.emplace("camera", camera.name);
    for (const Action& action : model.actions()) {
      using enum Action::Kind;
      if (action.kind == kKick || action.kind == kPolicy || action.kind == kOwnGait) continue;
      missing.emplace("action", action.name);
    }
    for (const Label& label : model.labels()) {
      bool is_complete = true;
      for (const char* language : {"en", "pt", "de", "ar"})
        is_complete &= label.texts.contains(language);
      if (is_complete) missing.erase({label.kind, label.name});
    }
    for (const auto& [kind, name] : missing) {
      ADD_FAILURE() << robot.path() << ": labels.yaml has no words for the " << kind << ' ' << name;
    }
  }
}

TEST(RobotFiles, LoadWithoutTheirMeshesWhichDrivingDoesNotNeed) {
  const CopiedRobot robot;
  fs::remove_all(robot.path() / "meshes");
  EXPECT_EQ(error_of(robot.path()), "");
}

/** Libraries of a program with windows may set the user's locale. */
TEST(RobotFiles, LoadAlikeWithADecimalComma) {
  const fs::path nao = data_path() / "robots" / "nao";
  const RobotModel with_point = RobotModel::load(nao);
  const TemporaryFolder folder;
  if (!make_decimal_comma(folder.path())) GTEST_SKIP() << "no localedef: install locales";
  setenv("LOCPATH", folder.path().c_str(), 1);
  ASSERT_NE(std::setlocale(LC_ALL, kDecimalComma), nullptr);
  EXPECT_EQ(std::strtod("1,5", nullptr), 1.5) << "the locale is not in effect";
  const RobotModel with_comma = RobotModel::load(nao);
  const SceneFile scene = SceneFile::find("soccer");
  std::setlocale(LC_ALL, "C");
  unsetenv("LOCPATH");
  EXPECT_EQ(scene.field->line_width, 0.05);
  ASSERT_EQ(with_comma.links().size(), with_point.links().size());
  for (size_t i = 0; i < with_point.links().size(); ++i) {
    EXPECT_EQ(with_comma.links()[i].mass, with_point.links()[i].mass) << with_point.links()[i].name;
  }
  for (size_t i = 0; i < with_point.joints().size(); ++i) {
    EXPECT_EQ(with_comma.joints()[i].upper, with_point.joints()[i].upper);
  }
}

TEST(RobotFiles, MayHaveAUrdfOfAnyName) {
  const CopiedRobot robot;
  fs::rename(robot.path() / "nao.urdf", robot.path() / "other.urdf");
  std::string text = robot.read("robot.yaml");
  robot.write("robot.yaml", text.replace(text.find("nao.urdf"), 8, "other.urdf"));
  EXPECT_EQ(RobotModel::load(robot.path()).urdf_file(), robot.path() / "other.urdf");
}

TEST(RobotFiles, AreNamedWhenTheyAreMissing) {
  for (const std::string& file : kRobotFiles) {
    const CopiedRobot robot;
    fs::remove(robot.path() / file);
    EXPECT_EQ(error_of(robot.path()), (robot.path() / file).string() + ": the file is missing");
  }
  EXPECT_THAT(error_of("/nowhere"), testing::HasSubstr("/nowhere/robot.yaml"));
}

/** One fault, and parts of the error's text besides the file's name. */
struct Fault {
  std::string_view claim;
  std::string_view file;
  /** The first occurrence of `from` after `after` becomes `to`. */
  std::string_view after;
  std::string_view from;
  std::string_view to;
  /** Fewer are followed by empty ones, which every text contains. */
  std::array<std::string_view, 3> error;
};

// NOLINTNEXTLINE(readability-identifier-naming): found by googletest by this name
void PrintTo(const Fault& fault, std::ostream* stream) {
  *stream << fault.claim;
}

class FaultyRobotFile : public testing::TestWithParam<Fault> {};

TEST_P(FaultyRobotFile, IsRejectedWithFileElementAndReason) {
  const Fault& fault = GetParam();
  const CopiedRobot robot;
  const std::string file(fault.file);
  std::string text = robot.read(file);
  const size_t start = text.find(fault.after);
  ASSERT_NE(start, std::string::npos);
  const size_t at = text.find(fault.from, start);
  ASSERT_NE(at, std::string::npos);
  robot.write(file, text.replace(at, fault.from.size(), fault.to));

  const std::string error = error_of(robot.path());
  EXPECT_THAT(error, testing::HasSubstr(file));
  for (const std::string_view part : fault.error) {
    EXPECT_THAT(error, testing::HasSubstr(std::string(part)));
  }
}

constexpr std::string_view kKnee = "<joint name=\"LKneePitch\"";
constexpr std::string_view kThigh = "<link name=\"LThigh\"";
constexpr std::string_view kRoot = "<robot";

// Tables, not testing::Values(...), which takes the compiler seconds for so many.
constexpr Fault kUrdfFaults[] = {
    Fault{"ThatIsNoXml", "nao.urdf", kRoot, "</link>", "</lin", {"robot"}},
    Fault{"ThatIsEmpty", "nao.urdf", kRoot, "<robot name", "<car name", {"<robot>"}},
    Fault{"WithTwoLinksOfOneName",
          "nao.urdf",
          kRoot,
          "<link name=\"RThigh\"",
          "<link name=\"LThigh\"",
          {"link LThigh", "twice"}},
    Fault{"WithTwoJointsOfOneName",
          "nao.urdf",
          kRoot,
          "<joint name=\"RKneePitch\"",
          "<joint name=\"LKneePitch\"",
          {"joint LKneePitch", "twice"}},
    Fault{"WithLimitsReversed",
          "nao.urdf",
          kKnee,
          "upper=\"2.112528\"",
          "upper=\"-1\"",
          {"joint LKneePitch", "lower limit"}},
    Fault{"WithoutLimits", "nao.urdf", kKnee, "<limit", "<limits", {"LKneePitch", "limit"}},
    Fault{"WithALimitOfNan",
          "nao.urdf",
          kKnee,
          "upper=\"2.112528\"",
          "upper=\"nan\"",
          {"upper", "nan"}},
    Fault{"WithAMassOfInfinity",
          "nao.urdf",
          kThigh,
          "value=\"0.38968\"",
          "value=\"1e999\"",
          {"LThigh", "1e999"}},
    Fault{"WithANegativeMass",
          "nao.urdf",
          kThigh,
          "value=\"0.38968\"",
          "value=\"-1\"",
          {"link LThigh", "mass"}},
    Fault{"WithAnImpossibleInertia",
          "nao.urdf",
          kThigh,
          "izz=\"0.000301215\"",
          "izz=\"0.301215\"",
          {"link LThigh", "inertia"}},
    Fault{"WithAnUnknownParent",
          "nao.urdf",
          kKnee,
          "parent link=\"LThigh\"",
          "parent link=\"LTigh\"",
          {"LTigh"}},
    Fault{"WithAnUnknownChild",
          "nao.urdf",
          kKnee,
          "child link=\"LTibia\"",
          "child link=\"LTibbia\"",
          {"LTibbia"}},
    Fault{"WithACycle",
          "nao.urdf",
          "<joint name=\"LHipYawPitch\"",
          "parent link=\"torso\"",
          "parent link=\"LFoot\"",
          {"joint LHipYawPitch", "LFoot", "cycle"}},
    Fault{"WithTwoParentsOfOneLink",
          "nao.urdf",
          kKnee,
          "child link=\"LTibia\"",
          "child link=\"LHip\"",
          {"LHip"}},
    Fault{"WithALinkThatNothingHolds",
          "nao.urdf",
          "</joint>",
          "<link name=\"Neck\">",
          "<link name=\"Stray\"/>\n<link name=\"Neck\">",
          {"root"}},
    Fault{"WithAnAxisOfNoDirection",
          "nao.urdf",
          kKnee,
          "<axis xyz=\"0 1 0\"/>",
          "<axis xyz=\"0 0 0\"/>",
          {"joint LKneePitch", "axis"}},
    Fault{"WithAJointOfAnUnknownType",
          "nao.urdf",
          kKnee,
          "type=\"revolute\"",
          "type=\"rubber\"",
          {"LKneePitch", "rubber"}},
    Fault{"WithAJointThatSlides",
          "nao.urdf",
          kKnee,
          "type=\"revolute\"",
          "type=\"prismatic\"",
          {"joint LKneePitch", "revolute or fixed"}},
    Fault{"ThatMimicsNothing",
          "nao.urdf",
          kRoot,
          "mimic joint=\"LHipYawPitch\"",
          "mimic joint=\"Nobody\"",
          {"joint RHipYawPitch", "Nobody"}},
    Fault{"ThatMimicsItself",
          "nao.urdf",
          kRoot,
          "mimic joint=\"LHipYawPitch\"",
          "mimic joint=\"RHipYawPitch\"",
          {"joint RHipYawPitch", "not a joint with a motor"}},
    Fault{"WithAMeshOutsideItsFolder",
          "nao.urdf",
          kThigh,
          "meshes/LThigh.glb",
          "meshes/../../passwd",
          {"link LThigh", "not inside"}},
    Fault{"WithAMeshOfAnAbsolutePath",
          "nao.urdf",
          kThigh,
          "meshes/LThigh.glb",
          "/etc/passwd",
          {"link LThigh", "not inside"}},
    Fault{"WithACollisionWithoutShape",
          "nao.urdf",
          kThigh,
          "<geometry><cylinder",
          "<geometry><tube",
          {"LThigh", "tube"}},
    Fault{"WithANegativeRadius",
          "nao.urdf",
          kThigh,
          "radius=\"0.041\"",
          "radius=\"-0.041\"",
          {"link LThigh: collision thigh_capsule", "radius"}},
    Fault{"WithAFlatBox",
          "nao.urdf",
          kRoot,
          "box size=\"0.109 0.14 0.102\"",
          "box size=\"0.109 0 0.102\"",
          {"link torso: collision chest", "size"}},
    Fault{"WithANumberTooFew",
          "nao.urdf",
          kThigh,
          "xyz=\"0.00138 0.00221 -0.05373\"",
          "xyz=\"0.00138 0.00221\"",
          {"LThigh"}}};

INSTANTIATE_TEST_SUITE_P(Urdf, FaultyRobotFile, testing::ValuesIn(kUrdfFaults),
                         [](const auto& info) { return std::string(info.param.claim); });

constexpr Fault kYamlFaults[] = {
    Fault{"ThatIsNoYaml", "robot.yaml", "", "motors:", "motors: [", {"robot.yaml"}},
    Fault{"WithAnUnknownKey",
          "robot.yaml",
          "",
          "actions:",
          "acttions: [a]\nactions:",
          {"acttions", "unknown"}},
    Fault{"WithoutAKey", "robot.yaml", "", "damping_gain: 0.8\n", "\n", {"lacks \"damping_gain\""}},
    Fault{"WithAKeyTwice",
          "robot.yaml",
          "",
          "dry_friction: 0.032",
          "dry_friction: 0.032\n    dry_friction: 1",
          {"dry_friction", "twice"}},
    Fault{"WithAnUnknownMotorType",
          "robot.yaml",
          "motors:",
          "HeadYaw: type_3A",
          "HeadYaw: type_9",
          {"motors.HeadYaw", "type_9"}},
    Fault{"WithAnUnknownJoint",
          "robot.yaml",
          "motors:",
          "HeadYaw:",
          "HeadYoww:",
          {"motors.HeadYoww", "not a joint"}},
    Fault{"WithoutAMotor",
          "robot.yaml",
          "motors:",
          "HeadYaw:",
          "# HeadYaw:",
          {"motors", "lacks \"HeadYaw\""}},
    Fault{"WithAMotorForTheMimic",
          "robot.yaml",
          "motors:",
          "RHipRoll:",
          "RHipYawPitch:",
          {"motors.RHipYawPitch", "not a joint with a motor"}},
    Fault{"WithANumberThatIsNone",
          "robot.yaml",
          "",
          "no_load_velocity: 7.4566",
          "no_load_velocity: fast",
          {"no_load_velocity", "number"}},
    Fault{"WithAnInfiniteNumber",
          "robot.yaml",
          "",
          "no_load_velocity: 7.4566",
          "no_load_velocity: .inf",
          {"no_load_velocity", "finite"}},
    Fault{"WithANegativeTorque",
          "robot.yaml",
          "",
          "continuous_torque: 1.547",
          "continuous_torque: -1.547",
          {"continuous_torque", "greater than 0"}},
    Fault{"WithCoupledLimitsReversed",
          "robot.yaml",
          "joint: HeadPitch",
          "-0.449073, 0.330041",
          "0.449073, 0.330041",
          {"coupled_limits[0].rows[0]"}},
    Fault{"WithCoupledRowsOutOfOrder",
          "robot.yaml",
          "joint: HeadPitch",
          "[-1.526988",
          "[-2.526988",
          {"coupled_limits[0].rows[1]", "larger"}},
    Fault{"WithAGroupOfAnUnknownJoint",
          "robot.yaml",
          "joint_groups:",
          "pitch: HeadPitch",
          "pitch: HeadPitsch",
          {"joint_groups[0].pitch", "HeadPitsch"}},
    Fault{"WithACameraOnNoLink",
          "robot.yaml",
          "cameras:",
          "link: CameraTop",
          "link: CameraTip",
          {"cameras[0].link", "CameraTip"}},
    Fault{"WithAFootSensorOnNoFoot",
          "robot.yaml",
          "foot_sensors:",
          "[LFsrFL",
          "[CameraTop",
          {"foot_sensors[0]", "sole"}},
    Fault{"WithASoleThatIsNotConvex",
          "robot.yaml",
          "soles:",
          "[-0.05072, -0.02138]",
          "[0.05072, 0.0]",
          {"soles.left.outline", "convex"}},
    Fault{"WithALinkInTwoClusters",
          "robot.yaml",
          "contact_clusters:",
          "[LTibia]",
          "[LHip]",
          {"contact_clusters[6]", "LHip", "twice"}},
    Fault{"WithAPairOfOneJointTwice",
          "robot.yaml",
          "mirrored_joints:",
          "right: RHipRoll",
          "right: LHipRoll",
          {"mirrored_joints"}},
    Fault{"WithAMirrorSignOfTwo",
          "robot.yaml",
          "mirrored_joints:",
          "sign: -1",
          "sign: 2",
          {"mirrored_joints[0].sign", "1 or -1"}},
    Fault{"WithAHandOnNoLink",
          "robot.yaml",
          "hands:",
          "LHandEffector",
          "LHandEffecter",
          {"hands.left", "LHandEffecter"}},
    Fault{"WithAReferenceToNoPosture",
          "robot.yaml",
          "reference_postures:",
          "rest: Crouch",
          "rest: Crutch",
          {"reference_postures.rest", "not a posture"}},
    Fault{"WithAFallPoseOfAnUnknownJoint",
          "robot.yaml",
          "fall_poses:",
          "HeadPitch",
          "HeadPitsch",
          {"fall_poses.forward.HeadPitsch", "mirrored_joints"}},
    Fault{"WithAnActionThatDoesNothingKnown",
          "robot.yaml",
          "actions:",
          "does: block",
          "does: juggle",
          {"actions[2].does", "gesture"}},
    Fault{"WithAKickWithoutASide",
          "robot.yaml",
          "actions:",
          "does: kick, side: left",
          "does: kick",
          {"actions[0]", "side"}},
    Fault{"WithHeightsReversed",
          "robot.yaml",
          "heights:",
          "on_feet: 0.19",
          "on_feet: 0.4",
          {"heights.on_feet", "below standing"}},
    Fault{"WithAUrdfElsewhere",
          "robot.yaml",
          "",
          "urdf: nao.urdf",
          "urdf: ../nao.urdf",
          {"urdf", "this folder"}},
    Fault{"WithAPostureOfAnUnknownJoint",
          "postures.yaml",
          "",
          "HeadYaw:",
          "HeadYoww:",
          {"postures[0].joints.HeadYoww", "not a joint"}},
    Fault{"WithAPostureThatLacksAJoint",
          "postures.yaml",
          "",
          "HeadYaw:",
          "# HeadYaw:",
          {"postures[0].joints", "lacks \"HeadYaw\""}},
    Fault{"WithAPostureOutsideItsLimits",
          "postures.yaml",
          "",
          "LKneePitch: 0",
          "LKneePitch: -0.5",
          {"postures[0].joints.LKneePitch", "outside"}},
    Fault{"WithAPostureOutsideCoupledLimits",
          "postures.yaml",
          "name: Crouch",
          "LAnkleRoll: 0",
          "LAnkleRoll: 0.3",
          {"LAnkleRoll", "outside"}},
    Fault{"WithAPostureOfNoFamily",
          "postures.yaml",
          "",
          "family: standing",
          "family: floating",
          {"family", "floating"}},
    Fault{"WithTwoPosturesOfOneName",
          "postures.yaml",
          "",
          "name: StandInit",
          "name: StandZero",
          {"postures[1].name", "twice"}},
    Fault{"WithNanInAPosture",
          "postures.yaml",
          "",
          "HeadPitch: 0",
          "HeadPitch: .nan",
          {"HeadPitch", "finite"}}};

INSTANTIATE_TEST_SUITE_P(Yaml, FaultyRobotFile, testing::ValuesIn(kYamlFaults),
                         [](const auto& info) { return std::string(info.param.claim); });

}  // namespace
}  // namespace nao
