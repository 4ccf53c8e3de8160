#include "daemons/head-camera/head_camera.h"

#include <gtest/gtest.h>

#include "common/data_path.h"
#include "rendering/decode_state.h"
#include "test/daemons/head-camera/truth.h"

namespace nao {
namespace {

constexpr int64_t kStep = 10000;

class HeadCameraTest : public testing::Test {
 protected:
  HeadCameraTest() : model_(RobotModel::load(data_path() / "robots" / "nao")) {
    naolcm::world_truth_t truth = make_truth(model_, "StandInit", 0.32);
    world_ = decode_truth(model_, truth);
    world_.utime = 5 * kStep;
    world_.pose_ball_in_world = Eigen::Translation3d(1.0, 0, 0.05) * Eigen::Isometry3d::Identity();
    earlier_ = world_;
    earlier_.utime = world_.utime - kStep;
  }

  std::vector<uint8_t> picture(const HeadCameraOptions& options, const WorldState* earlier) const {
    return HeadCamera(model_, options).take(world_, "top", 160, earlier).bgrx[0];
  }

  /** Pixels that differ clearly. */
  static int count_different(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
    int count = 0;
    for (size_t i = 0; i < a.size(); i += 4) count += std::abs(a[i] - b[i]) > 8 ? 1 : 0;
    return count;
  }

  RobotModel model_;
  WorldState world_;
  WorldState earlier_;
};

TEST_F(HeadCameraTest, BlursOnlyWhatMovesWhileTheShutterIsOpen) {
  HeadCameraOptions blurred;
  blurred.exposure = 0.02;
  const std::vector<uint8_t> sharp = picture({}, nullptr);
  EXPECT_EQ(count_different(picture(blurred, &earlier_), sharp), 0);
  earlier_.pose_ball_in_world->translation().y() -= 0.05;  // 5 m/s
  const int changed = count_different(picture(blurred, &earlier_), sharp);
  EXPECT_GT(changed, 300);
  EXPECT_LT(changed, 640 * 480 / 20) << "only about the ball";
  EXPECT_EQ(count_different(picture({}, &earlier_), sharp), 0) << "no exposure, no blur";
}

TEST_F(HeadCameraTest, BendsAndAddsNoiseOnlyWhenAsked) {
  const std::vector<uint8_t> ideal = picture({}, nullptr);
  HeadCameraOptions bent;
  bent.k1 = -0.2;
  EXPECT_GT(count_different(picture(bent, nullptr), ideal), 1000);
  HeadCameraOptions noisy;
  noisy.noise = 10;
  EXPECT_GT(count_different(picture(noisy, nullptr), ideal), 100000);
}

TEST_F(HeadCameraTest, MovesTheWorldAlongLinesAndShortestTurns) {
  RobotPose& robot = earlier_.robots[0];
  robot.pose_torso_in_world.translation().x() -= 0.1;
  robot.pose_torso_in_world.rotate(Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitZ()));
  robot.position[3] -= 0.2;
  const WorldState middle = interpolated(earlier_, world_, 0.5);
  EXPECT_EQ(middle.utime, world_.utime - kStep / 2);
  EXPECT_NEAR(middle.robots[0].position[3], world_.robots[0].position[3] - 0.1, 1e-12);
  const Eigen::Isometry3d way =
      middle.robots[0].pose_torso_in_world.inverse() * world_.robots[0].pose_torso_in_world;
  EXPECT_NEAR(Eigen::AngleAxisd(Eigen::Matrix3d(way.linear())).angle(), 0.2, 1e-9);
  EXPECT_NEAR(middle.robots[0].pose_torso_in_world.translation().x(),
              world_.robots[0].pose_torso_in_world.translation().x() - 0.05, 1e-12);
  EXPECT_TRUE(interpolated(earlier_, world_, 1)
                  .robots[0]
                  .pose_torso_in_world.isApprox(world_.robots[0].pose_torso_in_world));
}

}  // namespace
}  // namespace nao
