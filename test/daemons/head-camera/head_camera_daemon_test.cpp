#include "daemons/head-camera/head_camera_daemon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "common/bus.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/wall_clock.h"
#include "test/daemons/head-camera/truth.h"

namespace nao::camera {
namespace {

/** A camera on a private bus, and the messages that it publishes. */
class HeadCameraDaemonTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = new RobotModel(RobotModel::load(data_path() / "robots" / "nao"));
  }
  static void TearDownTestSuite() { delete model_; }

  HeadCameraDaemonTest() : bus_("memq://"), daemon_(bus_, *model_, {}) {
    bus_.subscribe<naolcm::image_t>(
        "NAO_HEAD_CAMERA_IMAGE", Bus::Queue::kAll,
        [this](const naolcm::image_t& image) { images_.push_back(image); });
    bus_.subscribe<naolcm::daemon_status_t>(
        kDaemonStatusChannel, Bus::Queue::kAll,
        [this](const naolcm::daemon_status_t& status) { status_ = status; });
    truth_ = make_truth(*model_, "StandInit", 0.32);
  }

  void request(const std::string& camera, int width, double rate = 30, int quality = 0) {
    naolcm::camera_command_t command{};
    command.source = "test";
    command.camera = camera;
    command.width = width;
    command.rate = rate;
    command.quality = quality;
    bus_.publish("NAO_HEAD_CAMERA_COMMAND", command);
  }

  /** Publishes the next state of the world and executes one step of the camera. */
  void step() {
    truth_.utime += 33000;
    bus_.publish(kWorldTruthChannel, truth_);
    deliver();
    daemon_.step(monotonic_seconds());
    deliver();
  }

  void deliver() {
    while (bus_.handle_for(0)) {
    }
  }

  static RobotModel* model_;
  Bus bus_;
  HeadCameraDaemon daemon_;
  naolcm::world_truth_t truth_;
  std::vector<naolcm::image_t> images_;
  naolcm::daemon_status_t status_;
};

RobotModel* HeadCameraDaemonTest::model_ = nullptr;

TEST_F(HeadCameraDaemonTest, IsWaitingUntilTruthArrives) {
  daemon_.publish_status();
  deliver();
  EXPECT_EQ(status_.state, "waiting");
  step();
  EXPECT_EQ(status_.state, "ready");
}

TEST_F(HeadCameraDaemonTest, RendersNothingWithoutARequest) {
  for (int i = 0; i < 5; ++i) step();
  EXPECT_TRUE(images_.empty());
  EXPECT_EQ(daemon_.num_frames(), 0);
}

TEST_F(HeadCameraDaemonTest, SendsTheRequestedImages) {
  request("top", 640);
  request("top", 160);
  request("bottom", 320);
  step();
  ASSERT_EQ(images_.size(), 3u);
  EXPECT_EQ(daemon_.num_frames(), 2);  // one for each camera, independent of the number of sizes
  for (const naolcm::image_t& image : images_) {
    EXPECT_EQ(image.utime, truth_.utime);
    EXPECT_EQ(image.height * 4, image.width * 3);
    EXPECT_EQ(image.format, "jpeg");
    ASSERT_GT(image.size_bytes, 500);
    EXPECT_EQ(image.data[0], 0xff);  // start of a JPEG file
    EXPECT_EQ(image.data[1], 0xd8);
    EXPECT_LT(image.getEncodedSize(), 65000);
    EXPECT_NEAR(image.fx / image.width, 544.34 / 640, 1e-4);  // camera.csv of the V5
    EXPECT_DOUBLE_EQ(image.cx, (image.width - 1) / 2.0);
  }
}

TEST_F(HeadCameraDaemonTest, StatesIntrinsicsDistortionAndExposure) {
  request("top", 320);
  step();
  ASSERT_EQ(images_.size(), 1u);
  const naolcm::image_t& image = images_[0];
  const auto camera = std::find_if(model_->cameras().begin(), model_->cameras().end(),
                                   [](const CameraModel& c) { return c.name == "top"; });
  EXPECT_NEAR(image.fx, 160 / std::tan(camera->horizontal_fov / 2), 1e-9);
  EXPECT_NEAR(image.fy, 120 / std::tan(camera->vertical_fov / 2), 1e-9);
  // Pixel (0, 0) is the center of the upper left pixel.
  EXPECT_NEAR(image.cx, 159.5, 1e-9);
  EXPECT_NEAR(image.cy, 119.5, 1e-9);
  for (const double coefficient : image.distortion) EXPECT_EQ(coefficient, 0);
  EXPECT_EQ(image.exposure_time, 0);
}

TEST_F(HeadCameraDaemonTest, UsesTheRequestedQuality) {
  request("top", 640, 30, 20);
  step();
  request("top", 640, 30, 90);
  step();
  ASSERT_EQ(images_.size(), 2u);
  EXPECT_GT(images_[1].size_bytes, 1.3 * images_[0].size_bytes);
}

TEST_F(HeadCameraDaemonTest, SendsTheSameImageAgainWhileNothingMoves) {
  request("top", 640);
  step();
  step();
  truth_.robots[0].joint_position[0] += 0.1;
  step();
  ASSERT_EQ(images_.size(), 3u);
  EXPECT_EQ(images_[1].data, images_[0].data);
  EXPECT_EQ(images_[1].utime, images_[0].utime + 33000);
  EXPECT_NE(images_[2].data, images_[1].data);
}

TEST_F(HeadCameraDaemonTest, NeverGoesBackInTime) {
  request("top", 160);
  step();
  naolcm::world_truth_t overtaken = truth_;
  overtaken.utime -= 10000;
  bus_.publish(kWorldTruthChannel, overtaken);
  deliver();
  step();
  ASSERT_EQ(images_.size(), 2u);
  EXPECT_GT(images_[1].utime, images_[0].utime);
  EXPECT_GE(bus_.counters().num_dropped, 1);
}

TEST_F(HeadCameraDaemonTest, FollowsARestartedSimulation) {
  truth_.utime = 100000000;
  request("top", 160);
  step();
  truth_.utime = 0;
  step();
  ASSERT_EQ(images_.size(), 2u);
  EXPECT_EQ(images_[1].utime, 33000);
}

TEST_F(HeadCameraDaemonTest, DoesNotRepeatAnUnchangedStateAtOnce) {
  request("top", 160);
  step();
  for (int i = 0; i < 5; ++i) {
    truth_.utime -= 33000;
    step();
  }
  EXPECT_EQ(images_.size(), 1u);
}

TEST_F(HeadCameraDaemonTest, RejectsAnInvalidStateAndKeepsTheLastValidOne) {
  request("top", 160);
  step();
  const naolcm::world_truth_t good = truth_;
  const auto expect_rejected = [&](const char* what) {
    const int64_t num_dropped = bus_.counters().num_dropped;
    truth_.utime += 33000;
    bus_.publish(kWorldTruthChannel, truth_);
    deliver();
    EXPECT_EQ(bus_.counters().num_dropped, num_dropped + 1) << what;
    truth_ = good;
  };
  truth_.robots[0].joint_names[3] = "Tail";
  expect_rejected("unknown joint");
  truth_.robots[0].joint_position[3] = std::numeric_limits<double>::quiet_NaN();
  expect_rejected("angle that is NaN");
  truth_.robots[0].position_torso_in_world[0] = std::numeric_limits<double>::infinity();
  expect_rejected("infinite position");
  truth_.robots[0].orientation_torso_in_world[0] = 0;
  expect_rejected("quaternion of length 0");
  truth_.position_ball_in_world[1] = std::numeric_limits<double>::quiet_NaN();
  expect_rejected("ball position that is NaN");
  step();
  EXPECT_EQ(images_.size(), 2u);
}

TEST_F(HeadCameraDaemonTest, RejectsARequestThatCannotBeServed) {
  const int64_t num_dropped = bus_.counters().num_dropped;
  request("rear", 640);
  request("top", 1280);
  request("top", 640, 1000);
  step();
  EXPECT_EQ(bus_.counters().num_dropped, num_dropped + 3);
  EXPECT_TRUE(images_.empty());
}

TEST_F(HeadCameraDaemonTest, WaitsForItsOwnRobot) {
  truth_.robots[0].robot = "OTHER";
  request("top", 160);
  step();
  EXPECT_TRUE(images_.empty());
  EXPECT_EQ(status_.state, "waiting");
  EXPECT_THAT(status_.detail, testing::HasSubstr("no robot NAO"));
}

TEST_F(HeadCameraDaemonTest, DrawsAPlainFloorForAnUnknownScene) {
  truth_.scene = "moon";
  request("top", 160);
  step();
  EXPECT_EQ(images_.size(), 1u);
}

}  // namespace
}  // namespace nao::camera
