#include "daemons/vision/vision_daemon.h"

#include <gmock/gmock.h>

#include <cmath>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/play_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/bus.h"
#include "common/data_path.h"
#include "drawn_field.h"

namespace nao::vision {
namespace {

constexpr int64_t kTime = 5000000;

class VisionDaemonTest : public testing::Test {
 protected:
  VisionDaemonTest()
      : model_(RobotModel::load(data_path() / "robots" / "nao")),
        bus_("memq://"),
        daemon_(bus_, model_, {}) {
    bus_.subscribe<naolcm::vision_state_t>(
        "NAO_VISION_STATE", Bus::Queue::kAll,
        [this](const naolcm::vision_state_t& state) { states_.push_back(state); });
    bus_.subscribe<naolcm::daemon_status_t>(
        kDaemonStatusChannel, Bus::Queue::kAll,
        [this](const naolcm::daemon_status_t& status) { status_ = status; });
  }

  /** A robot that stands upright with all joints at 0. */
  naolcm::robot_state_t robot_state(int64_t utime) const {
    naolcm::robot_state_t state{};
    state.utime = utime;
    state.joint_names = model_.motor_names();
    state.num_joints = model_.num_motors();
    state.joint_position.assign(model_.num_motors(), 0);
    state.joint_velocity.assign(model_.num_motors(), 0);
    state.position_torso_in_odometry[0] = 1;
    state.position_torso_in_odometry[2] = 0.333;
    state.orientation_torso_in_odometry[0] = 1;
    return state;
  }

  /** The image of a ball, as the bottom camera sees it. */
  naolcm::image_t ball_image(const Eigen::Vector2d& ball, int64_t utime) const {
    DrawnField field(0);
    const Eigen::Isometry3d torso =
        Eigen::Translation3d(0, 0, 0.333) * Eigen::Isometry3d::Identity();
    for (const CameraModel& camera : model_.cameras()) {
      if (camera.name != "bottom") continue;
      const std::vector<double> zero(model_.num_motors(), 0.0);
      field.pose = torso * model_.link_poses(zero)[camera.link];
    }
    field.ball = ball;
    const VisionInput input = field.input();
    naolcm::image_t image{};
    image.utime = utime;
    image.camera = "bottom";
    image.width = 640;
    image.height = 480;
    image.fx = field.calibration.fx;
    image.fy = field.calibration.fy;
    image.cx = field.calibration.cx;
    image.cy = field.calibration.cy;
    image.format = "jpeg";
    cv::imencode(".jpg", input.bgr, image.data, {cv::IMWRITE_JPEG_QUALITY, 85});
    image.size_bytes = static_cast<int32_t>(image.data.size());
    return image;
  }

  void deliver() { deliver(bus_, daemon_); }

  static void deliver(Bus& bus, VisionDaemon& daemon) {
    const auto handle = [&] {
      while (bus.handle_for(0)) {
      }
    };
    handle();
    daemon.process_images();
    handle();
  }

  RobotModel model_;
  Bus bus_;
  VisionDaemon daemon_;
  std::vector<naolcm::vision_state_t> states_;
  naolcm::daemon_status_t status_{};
};

TEST_F(VisionDaemonTest, LocatesTheBallByTheRobotsStateAtTheImagesTime) {
  bus_.publish("NAO_ROBOT_STATE", robot_state(kTime - 5000));
  bus_.publish("NAO_ROBOT_STATE", robot_state(kTime + 5000));
  deliver();
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", ball_image({0.55, 0.05}, kTime));
  deliver();
  ASSERT_EQ(states_.size(), 1u);
  EXPECT_EQ(states_[0].utime, kTime);
  EXPECT_EQ(states_[0].camera, "bottom");
  EXPECT_EQ(states_[0].image_status, naolcm::vision_state_t::IMAGE_STATUS_OK);
  ASSERT_EQ(states_[0].has_ball, 1);
  EXPECT_NEAR(states_[0].ball_position_in_odometry[0], 1.55, 0.03);
  EXPECT_NEAR(states_[0].ball_position_in_odometry[1], 0.05, 0.03);
  EXPECT_EQ(states_[0].has_field_pose, 0);
}

TEST_F(VisionDaemonTest, DetectsWithoutPositionsWhenTheRobotsStateIsMissing) {
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", ball_image({0.55, 0.05}, kTime));
  deliver();
  ASSERT_EQ(states_.size(), 1u);
  EXPECT_EQ(states_[0].has_ball, 0);
  ASSERT_GE(states_[0].num_detections, 1);
  EXPECT_EQ(states_[0].detections[0].kind, naolcm::detection_t::KIND_BALL);
  EXPECT_TRUE(std::isnan(states_[0].detections[0].position_in_heading[0]));
}

TEST_F(VisionDaemonTest, DropsDamagedImagesAndWrongIntrinsics) {
  naolcm::image_t image = ball_image({0.55, 0.05}, kTime);
  image.data.resize(image.data.size() / 2);
  image.size_bytes = static_cast<int32_t>(image.data.size());
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", image);
  deliver();
  image = ball_image({0.55, 0.05}, kTime + 1);
  image.fx = std::nan("");
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", image);
  deliver();
  EXPECT_TRUE(states_.empty());
  EXPECT_EQ(daemon_.num_refused(), 2);
}

TEST_F(VisionDaemonTest, ProcessesOneImageOfEachTime) {
  const naolcm::image_t image = ball_image({0.55, 0.05}, kTime);
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", image);
  deliver();
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", image);
  deliver();
  EXPECT_EQ(states_.size(), 1u);
}

TEST_F(VisionDaemonTest, ProcessesTheNewestOfSeveralWaitingImages) {
  for (int i = 0; i < 5; ++i) {
    bus_.publish("NAO_HEAD_CAMERA_IMAGE", ball_image({0.55, 0.05}, kTime + 33000 * i));
  }
  deliver();
  ASSERT_EQ(states_.size(), 1u);
  EXPECT_EQ(states_[0].utime, kTime + 33000 * 4);
}

TEST_F(VisionDaemonTest, LeavesNarrowImagesOutWhileWideOnesOfTheCameraCome) {
  const auto narrow = [&](int64_t utime) {
    naolcm::image_t image = ball_image({0.55, 0.05}, utime);
    cv::Mat half;
    cv::resize(cv::imdecode(image.data, cv::IMREAD_COLOR), half, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::imencode(".jpg", half, image.data);
    image.size_bytes = static_cast<int32_t>(image.data.size());
    image.width /= 2;
    image.height /= 2;
    for (double* length : {&image.fx, &image.fy, &image.cx, &image.cy}) *length /= 2;
    return image;
  };
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", ball_image({0.55, 0.05}, kTime));
  deliver();
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", narrow(kTime + 66000));
  deliver();
  EXPECT_EQ(states_.size(), 1u);
  bus_.publish("NAO_HEAD_CAMERA_IMAGE", narrow(kTime + 600000));
  deliver();
  EXPECT_EQ(states_.size(), 2u);
}

TEST_F(VisionDaemonTest, ReportsThePoseOnTheFieldWithAStartPose) {
  VisionOptions options;
  options.field_start = {FieldModel(SceneFile::find("soccer")), Pose2{{-2, 1}, M_PI / 2}};
  Bus bus("memq://");
  VisionDaemon daemon(bus, model_, options);
  std::vector<naolcm::vision_state_t> states;
  bus.subscribe<naolcm::vision_state_t>(
      "NAO_VISION_STATE", Bus::Queue::kAll,
      [&](const naolcm::vision_state_t& state) { states.push_back(state); });
  bus.publish("NAO_ROBOT_STATE", robot_state(kTime - 5000));
  bus.publish("NAO_ROBOT_STATE", robot_state(kTime + 5000));
  deliver(bus, daemon);
  bus.publish("NAO_HEAD_CAMERA_IMAGE", ball_image({0.55, 0.05}, kTime));
  deliver(bus, daemon);
  ASSERT_EQ(states.size(), 1u);
  ASSERT_EQ(states[0].has_field_pose, 1);
  // robot_state() is 1 m ahead of the start.
  EXPECT_NEAR(states[0].torso_in_field[0], -2, 0.2);
  EXPECT_NEAR(states[0].torso_in_field[1], 2, 0.2);
  EXPECT_NEAR(states[0].torso_in_field[2], M_PI / 2, 0.1);
  EXPECT_GT(states[0].field_pose_covariance[0][0], 0);
}

TEST_F(VisionDaemonTest, ReportsItsStatus) {
  daemon_.publish_status(10);
  deliver();
  EXPECT_EQ(status_.program, "nao-vision");
}

TEST_F(VisionDaemonTest, RequestsImagesOfTheCameraThatPlayNeeds) {
  std::vector<naolcm::camera_command_t> requests;
  bus_.subscribe<naolcm::camera_command_t>(
      "NAO_HEAD_CAMERA_COMMAND", Bus::Queue::kAll,
      [&](const naolcm::camera_command_t& request) { requests.push_back(request); });
  naolcm::play_state_t play{};
  for (const char* camera : {"", "top", "top", "bottom", ""}) {
    play.camera = camera;
    bus_.publish("NAO_PLAY_STATE", play);
    bus_.handle();
  }
  ASSERT_EQ(requests.size(), 2u) << "at once when it changes";
  EXPECT_EQ(requests[0].camera, "top");
  EXPECT_EQ(requests[1].camera, "bottom");
  EXPECT_EQ(requests[1].width, 640);
}

}  // namespace
}  // namespace nao::vision
