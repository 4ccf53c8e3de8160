#include "inspection/foxglove_converter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "common/data_path.h"
#include "common/json_text.h"
#include "inspection/foxglove_schemas.h"

namespace nao {
namespace {

using Json = nlohmann::json;

const RobotModel& robot() {
  static const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  return model;
}

template <class Message>
std::vector<uint8_t> encoded(const Message& message) {
  std::vector<uint8_t> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/** A robot with bent joints, leaning, 2 m ahead. */
naolcm::robot_state_t leaning_state(int64_t utime) {
  naolcm::robot_state_t state{};
  state.utime = utime;
  state.joint_names = robot().motor_names();
  state.num_joints = robot().num_motors();
  for (int i = 0; i < state.num_joints; ++i) {
    const Joint& joint = robot().motor_joint(i);
    state.joint_position.push_back(0.3 * joint.lower + 0.7 * joint.upper);
  }
  state.joint_velocity.resize(state.num_joints);
  state.position_torso_in_odometry[0] = 2;
  state.position_torso_in_odometry[2] = 0.3;
  // Heading 90 degrees to the left.
  state.orientation_torso_in_odometry[0] = state.orientation_torso_in_odometry[3] = std::sqrt(0.5);
  state.velocity_torso_in_heading[0] = 0.1;
  return state;
}

naolcm::image_t image(const std::string& camera, int width, int64_t utime) {
  naolcm::image_t image{};
  image.camera = camera;
  image.width = width;
  image.utime = utime;
  image.format = "jpeg";
  image.data = {1, 2, 3};
  image.size_bytes = 3;
  return image;
}

class FoxgloveConverterTest : public testing::Test {
 protected:
  /** Converts a message; the outputs by topic. */
  std::map<std::string, Json> convert(const std::string& channel,
                                      const std::vector<uint8_t>& bytes) {
    std::map<std::string, Json> outputs;
    converter_.convert(
        channel, bytes, [](size_t) { return true; },
        [&](size_t output, const std::string& json) {
          outputs[converter_.outputs()[output].topic] = parse_json(json);
        });
    return outputs;
  }

  FoxgloveConverter converter_{robot(), "NAO"};
};

Eigen::Isometry3d pose_of(const Json& transform) {
  const Json& p = transform["translation"];
  const Json& q = transform["rotation"];
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << p["x"], p["y"], p["z"];
  pose.linear() = Eigen::Quaterniond(q["w"], q["x"], q["y"], q["z"]).toRotationMatrix();
  return pose;
}

TEST_F(FoxgloveConverterTest, TransformsLeadFromTheWorldToEveryLink) {
  const naolcm::robot_state_t state = leaning_state(1'000'000);
  const Json message = convert("NAO_ROBOT_STATE", encoded(state)).at("/NAO/transforms");
  std::map<std::string, Json> by_child;
  for (const Json& transform : message["transforms"]) {
    EXPECT_EQ(transform["timestamp"]["sec"], 1);
    by_child[transform["child_frame_id"]] = transform;
  }
  const auto poses = robot().link_poses(state.joint_position);
  const Eigen::Isometry3d torso =
      to_pose(state.position_torso_in_odometry, state.orientation_torso_in_odometry);
  for (size_t link = 0; link < robot().links().size(); ++link) {
    SCOPED_TRACE(robot().links()[link].name);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (std::string frame = robot().links()[link].name; frame != "world";) {
      ASSERT_TRUE(by_child.contains(frame)) << frame;
      pose = pose_of(by_child[frame]) * pose;
      frame = by_child[frame]["parent_frame_id"];
    }
    // Rounded to 1e-6 at each of up to 8 joints.
    EXPECT_TRUE(pose.isApprox(torso * poses[link], 2e-5));
  }
  // The optical axis is the camera's x axis.
  const CameraModel& camera = robot().cameras().front();
  const Eigen::Isometry3d optical =
      pose_of(by_child.at(RobotTransforms::optical_frame(robot().links()[camera.link].name)));
  EXPECT_TRUE(
      (optical.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-5));
}

TEST_F(FoxgloveConverterTest, FixedTransformsComeOnceASecond) {
  const auto num_transforms = [&](int64_t utime) {
    return convert("NAO_ROBOT_STATE", encoded(leaning_state(utime)))
        .at("/NAO/transforms")["transforms"]
        .size();
  };
  const size_t all = num_transforms(1'000'000);
  EXPECT_LT(num_transforms(1'500'000), all);
  EXPECT_EQ(num_transforms(2'000'000), all);
}

TEST_F(FoxgloveConverterTest, WhatIsDrawnComesAtMostFiftyTimesASecond) {
  int num_drawn = 0;
  int num_odometry = 0;
  for (int64_t utime = 0; utime < 1'000'000; utime += 10'000) {
    const auto outputs = convert("NAO_ROBOT_STATE", encoded(leaning_state(utime)));
    num_drawn += static_cast<int>(outputs.contains("/NAO/balance"));
    num_odometry += static_cast<int>(outputs.contains("/NAO/odometry"));
  }
  EXPECT_EQ(num_drawn, 50);
  EXPECT_EQ(num_odometry, 100);
  EXPECT_TRUE(convert("NAO_ROBOT_STATE", encoded(leaning_state(0))).contains("/NAO/balance"))
      << "the robot was restarted";
}

TEST_F(FoxgloveConverterTest, OdometryHasTheVelocityInTheTorsosFrame) {
  naolcm::robot_state_t state = leaning_state(0);
  // It leans forward by 90 degrees: the forward direction is now up in the torso's frame.
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ())) *
      Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()));
  const double wxyz[]{q.w(), q.x(), q.y(), q.z()};
  std::copy(wxyz, wxyz + 4, state.orientation_torso_in_odometry);
  const Json message = convert("NAO_ROBOT_STATE", encoded(state)).at("/NAO/odometry");
  EXPECT_EQ(message["frame_id"], "odometry");
  EXPECT_EQ(message["body_frame_id"], robot().links().front().name);
  EXPECT_NEAR(message["linear_velocity"]["x"], 0.1 * std::cos(0.5), 1e-6);
  EXPECT_NEAR(message["linear_velocity"]["y"], 0, 1e-6);
  EXPECT_NEAR(message["linear_velocity"]["z"], 0.1 * std::sin(0.5), 1e-6);
}

TEST_F(FoxgloveConverterTest, LeavesOutWhatIsNotMeasured) {
  naolcm::sensor_state_t state{};
  state.num_joints = 1;
  state.joint_names = {"HeadYaw"};
  state.joint_position = {0.25};
  state.joint_velocity = {std::numeric_limits<double>::quiet_NaN()};
  state.joint_torque = state.joint_target_position = state.joint_stiffness = {0};
  const Json message = convert("NAO_SENSOR_STATE", encoded(state)).at("/NAO/joint_states");
  EXPECT_EQ(message["joints"], parse_json(R"([{"name":"HeadYaw","position":0.25,"effort":0.0}])"));
}

TEST_F(FoxgloveConverterTest, ShowsTheLargestOfACamerasImages) {
  const auto is_shown = [&](int width, int64_t utime) {
    return convert("NAO_HEAD_CAMERA_IMAGE", encoded(image("top", width, utime)))
        .contains("/NAO/camera/top/image");
  };
  EXPECT_TRUE(is_shown(320, 0));
  EXPECT_TRUE(is_shown(640, 10));
  EXPECT_FALSE(is_shown(320, 20));
  EXPECT_TRUE(is_shown(320, 2'000'000)) << "the large one is no longer requested";
  EXPECT_TRUE(convert("NAO_HEAD_CAMERA_IMAGE", encoded(image("unknown", 320, 0))).empty());
}

TEST_F(FoxgloveConverterTest, AlignsOdometryWithTheTrueWorld) {
  naolcm::world_truth_t truth{};
  truth.num_robots = 1;
  truth.robots.resize(1);
  truth.robots[0].robot = "NAO";
  truth.robots[0].position_torso_in_world[0] = -3;
  truth.robots[0].orientation_torso_in_world[0] = 1;
  const auto world = convert("WORLD_TRUTH", encoded(truth));
  EXPECT_EQ(world.at("/world/transforms")["transforms"][0]["child_frame_id"],
            "truth/NAO/" + robot().links().front().name);
  const Json message = convert("NAO_ROBOT_STATE", encoded(leaning_state(1))).at("/NAO/transforms");
  const Eigen::Isometry3d torso =
      pose_of(message["transforms"][0]) * pose_of(message["transforms"][2]);
  EXPECT_EQ(message["transforms"][0]["parent_frame_id"], "world");
  EXPECT_NEAR(torso.translation().x(), -3, 1e-5);
}

TEST_F(FoxgloveConverterTest, DrawsFootstepsDetectionsBallAndForces) {
  naolcm::motion_state_t motion{};
  motion.num_footsteps = 2;
  motion.footsteps.resize(2);
  motion.footsteps[0].is_left = 1;
  const Json steps = convert("NAO_MOTION_STATE", encoded(motion)).at("/NAO/footsteps");
  EXPECT_EQ(steps["entities"][0]["lines"].size(), 2u);

  naolcm::vision_state_t vision{};
  vision.num_detections = 2;
  vision.detections.resize(2);
  vision.detections[0].kind = naolcm::detection_t::KIND_GOAL_POST;
  vision.detections[1].position_in_heading[0] = std::nan("");
  const Json seen = convert("NAO_VISION_STATE", encoded(vision)).at("/NAO/detections");
  ASSERT_EQ(seen["entities"][0]["texts"].size(), 1u) << "one position is unknown";
  EXPECT_EQ(seen["entities"][0]["texts"][0]["text"], "goal post");

  naolcm::world_truth_t truth{};
  truth.has_ball = 1;
  truth.num_contacts = 1;
  truth.contacts.resize(1);
  truth.contacts[0].force_on_a_in_world[2] = 25;
  const Json world = convert("WORLD_TRUTH", encoded(truth)).at("/world/scene");
  EXPECT_EQ(world["entities"][0]["spheres"].size(), 1u);
  EXPECT_EQ(world["entities"][0]["arrows"].size(), 1u);
}

TEST_F(FoxgloveConverterTest, IgnoresDamagedMessages) {
  std::mt19937 random(1);
  const auto whole = encoded(leaning_state(0));
  for (const char* channel : {"NAO_SENSOR_STATE", "NAO_ROBOT_STATE", "NAO_MOTION_STATE",
                              "NAO_VISION_STATE", "WORLD_TRUTH", "NAO_HEAD_CAMERA_IMAGE"}) {
    EXPECT_TRUE(convert(channel, {}).empty());
    EXPECT_TRUE(convert(channel, {1, 2, 3}).empty());
  }
  for (size_t size = 0; size < whole.size(); ++size) {
    EXPECT_TRUE(convert("NAO_ROBOT_STATE", {whole.begin(), whole.begin() + size}).empty()) << size;
  }
  // Between the numbers of joints and of corners: LCM's decoder takes memory for as many as they
  // say.
  constexpr size_t kFirst = 8 + 8 + 8 + 4;
  for (int round = 0; round < 1000; ++round) {
    auto damaged = whole;
    for (int i = 0; i < 3; ++i) {
      damaged[kFirst + random() % (damaged.size() - kFirst - 4)] = static_cast<uint8_t>(random());
    }
    // It must neither crash nor write invalid JSON, which convert() parses.
    (void)convert("NAO_ROBOT_STATE", damaged);
  }
}

TEST(FoxgloveSchemas, AreJsonAndNamedAsFoxgloveNamesThem) {
  const FoxgloveConverter converter(robot(), "NAO");
  for (const auto& output : converter.outputs()) {
    const Json schema = parse_json(foxglove_schema(output.schema));
    EXPECT_EQ(schema["title"], output.schema);
    EXPECT_EQ(schema["type"], "object");
  }
}

}  // namespace
}  // namespace nao
