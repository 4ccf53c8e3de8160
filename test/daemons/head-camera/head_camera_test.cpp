#include "daemons/head-camera/head_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <naolcm/world_truth_t.hpp>

#include "common/data_path.h"
#include "rendering/decode_state.h"
#include "test/daemons/head-camera/truth.h"

namespace nao::camera {
namespace {

constexpr int64_t kStep = 10000;
constexpr int kWidth = 640;
constexpr int kHeight = 480;

class HeadCameraTest : public testing::Test {
 protected:
  HeadCameraTest() : model_(RobotModel::load(data_path() / "robots" / "nao")) {
    RobotModels models(model_);
    world_ = decode_truth(models, make_truth(model_, "StandInit", 0.32));
    world_.utime = 5 * kStep;
    world_.pose_ball_in_world = Eigen::Translation3d(1.0, 0, 0.05) * Eigen::Isometry3d::Identity();
    earlier_ = world_;
    earlier_.utime = world_.utime - kStep;
  }

  const CameraModel& camera() const { return model_.cameras().front(); }

  std::vector<uint8_t> image(const HeadCameraOptions& options, const WorldState* earlier) const {
    return HeadCamera(model_, options).take(world_, camera().name, 160, earlier).bgrx[0];
  }

  /** Number of pixels that differ clearly. */
  static int count_different(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
    int count = 0;
    for (size_t i = 0; i < a.size(); i += 4) count += std::abs(a[i] - b[i]) > 8 ? 1 : 0;
    return count;
  }

  /** Pixel at the middle of the rectangle that encloses all pixels that differ clearly. */
  static Eigen::Vector2d center_of_difference(const std::vector<uint8_t>& a,
                                              const std::vector<uint8_t>& b) {
    Eigen::AlignedBox2d box;
    for (int row = 0; row < kHeight; ++row) {
      for (int u = 0; u < kWidth; ++u) {
        const size_t i = 4 * (static_cast<size_t>(row) * kWidth + u);
        if (std::abs(a[i] - b[i]) > 8) box.extend(Eigen::Vector2d(u, kHeight - 1 - row));
      }
    }
    return box.center();
  }

  /** Position of a point of the world in the ideal camera's image, in focal lengths: x right, y
   * down. */
  Eigen::Vector2d ideal_point(const Eigen::Vector3d& point_in_world) const {
    const RobotPose& robot = world_.robots[0];
    const auto poses = link_poses_in_world(model_, robot.pose_torso_in_world, robot.position);
    const Eigen::Vector3d point = poses[camera().link].inverse() * point_in_world;
    return {-point.y() / point.x(), -point.z() / point.x()};
  }

  /** Pixel of a point in focal lengths. */
  Eigen::Vector2d pixel(const Eigen::Vector2d& point) const {
    const PinholeCamera pinhole = pinhole_of(camera());
    return {pinhole.cx + pinhole.fx * point.x(), pinhole.cy + pinhole.fy * point.y()};
  }

  RobotModel model_;
  WorldState world_;
  WorldState earlier_;
};

TEST_F(HeadCameraTest, BlursOnlyWhatMovesDuringTheExposure) {
  HeadCameraOptions blurred;
  blurred.exposure = 0.02;
  const std::vector<uint8_t> sharp = image({}, nullptr);
  EXPECT_EQ(count_different(image(blurred, &earlier_), sharp), 0);
  earlier_.pose_ball_in_world->translation().y() -= 0.05;  // 5 m/s
  const int changed = count_different(image(blurred, &earlier_), sharp);
  EXPECT_GT(changed, 300);
  EXPECT_LT(changed, kWidth * kHeight / 20) << "only around the ball";
  EXPECT_EQ(count_different(image({}, &earlier_), sharp), 0) << "no exposure, no blur";
}

TEST_F(HeadCameraTest, StatesTheTimeAtWhichABlurredBodyIsAtItsMeanPosition) {
  HeadCameraOptions options;
  options.exposure = 0.02;
  options.shadow_size = 0;  // the shadow would count as part of the ball
  const double velocity = 5;
  // Far enough that the whole ball is in the image.
  world_.pose_ball_in_world->translation().x() = 1.6;
  earlier_.pose_ball_in_world->translation().x() = 1.6;
  earlier_.pose_ball_in_world->translation().y() -= velocity * 1e-6 * kStep;
  HeadCamera head_camera(model_, options);
  const CameraFrame blurred = head_camera.take(world_, camera().name, kWidth, &earlier_);
  EXPECT_EQ(blurred.utime, world_.utime - 10000) << "mid exposure";
  EXPECT_EQ(blurred.exposure_time, 0.02);

  const Eigen::Vector3d end = world_.pose_ball_in_world->translation();
  const double before_end = 1e-6 * static_cast<double>(world_.utime - blurred.utime);
  const Eigen::Vector3d at_utime = end - Eigen::Vector3d(0, velocity * before_end, 0);
  world_.pose_ball_in_world.reset();
  const CameraFrame without_ball = head_camera.take(world_, camera().name, kWidth);
  const Eigen::Vector2d seen = center_of_difference(blurred.bgrx[0], without_ball.bgrx[0]);
  // The image of a ball is not quite symmetric. An error of an eighth of the exposure, as if the
  // samples began at its end, would be 4 pixels.
  EXPECT_LT((seen - pixel(ideal_point(at_utime))).norm(), 2) << seen.transpose();
}

TEST_F(HeadCameraTest, StatesTheTimeOfTheStateWithoutExposure) {
  HeadCamera head_camera(model_, {});
  EXPECT_EQ(head_camera.take(world_, camera().name, kWidth, &earlier_).utime, world_.utime);
  EXPECT_EQ(head_camera.frame().exposure_time, 0);
}

TEST_F(HeadCameraTest, ComputesAnImageOnlyOfWhatHasChanged) {
  HeadCamera head_camera(model_, {});
  const CameraFrame first = head_camera.take(world_, camera().name, kWidth);
  world_.utime += kStep;
  world_.robots[0].position[0] += 1e-9;
  const CameraFrame second = head_camera.take(world_, camera().name, 160);
  EXPECT_EQ(second.utime, world_.utime);
  EXPECT_EQ(second.num_changes, first.num_changes);
  EXPECT_EQ(second.bgrx[0], first.bgrx[0]);
  EXPECT_EQ(second.bgrx[2].size(), 4u * 160 * 120);
  RobotPose& robot = world_.robots[0];
  const LitLight red{"left-eye", {1, 0, 0}};
  const std::vector<std::function<void()>> changes = {
      [&] { robot.position[0] += 2e-5; },
      [&] { robot.pose_torso_in_world.translation().x() += 2e-5; },
      [&] { robot.lights.push_back(red); },
      [&] { robot.lights.back().rgb.x() = 0.5; },
      [&] { robot.number = 3; },
      [&] { world_.pose_ball_in_world->translation().x() += 2e-5; },
      [&] { world_.pose_ball_in_world.reset(); },
      [&] { world_.scene = "empty"; },
      [&] {
        world_.robots.push_back(robot);
        world_.robots.back().name = "OTHER";
      }};
  int64_t num_changes = first.num_changes;
  for (const auto& change : changes) {
    change();
    EXPECT_EQ(head_camera.take(world_, camera().name, kWidth).num_changes, ++num_changes);
    EXPECT_EQ(head_camera.take(world_, camera().name, kWidth).num_changes, num_changes);
  }
  EXPECT_GT(head_camera.take(world_, model_.cameras().back().name, kWidth).num_changes,
            num_changes);
}

TEST_F(HeadCameraTest, ShowsAKnownPointAtThePixelOfTheDistortionModel) {
  HeadCameraOptions options;
  options.shadow_size = 0;
  options.distortion = {.k1 = -0.3, .k2 = 0.1, .p1 = 0.01, .p2 = -0.01, .k3 = -0.01};
  HeadCamera head_camera(model_, options);
  WorldState without_ball = world_;
  without_ball.pose_ball_in_world.reset();
  const auto background = head_camera.take(without_ball, camera().name, kWidth).bgrx[0];
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(1.4, 0, 0.05), {1.6, 0.5, 0.05}, {1.5, -0.4, 0.05}, {2.0, -0.6, 0.4}}) {
    world_.pose_ball_in_world->translation() = place;
    const CameraFrame& frame = head_camera.take(world_, camera().name, kWidth);
    EXPECT_EQ(frame.distortion.coefficients(), options.distortion.coefficients());
    const Eigen::Vector2d seen = center_of_difference(frame.bgrx[0], background);
    const Eigen::Vector2d ideal = ideal_point(place);
    // Brown-Conrady model as in OpenCV's documentation, not by the function under test.
    const double x = ideal.x();
    const double y = ideal.y();
    const double r2 = x * x + y * y;
    const double radial = 1 - 0.3 * r2 + 0.1 * r2 * r2 - 0.01 * r2 * r2 * r2;
    const Eigen::Vector2d expected(x * radial + 2 * 0.01 * x * y - 0.01 * (r2 + 2 * x * x),
                                   y * radial + 0.01 * (r2 + 2 * y * y) - 2 * 0.01 * x * y);
    EXPECT_LT((seen - pixel(expected)).norm(), 1.5) << place.transpose();
    EXPECT_GT((pixel(ideal) - pixel(expected)).norm(), 2) << "the test needs a visible distortion";
  }
}

TEST_F(HeadCameraTest, DistortsAndAddsNoiseOnlyIfRequested) {
  const std::vector<uint8_t> ideal = image({}, nullptr);
  HeadCameraOptions distorted;
  distorted.distortion.k1 = -0.2;
  EXPECT_GT(count_different(image(distorted, nullptr), ideal), 1000);
  HeadCameraOptions noisy;
  noisy.noise = 10;
  EXPECT_GT(count_different(image(noisy, nullptr), ideal), 100000);
}

TEST_F(HeadCameraTest, InterpolatesPositionsLinearlyAndOrientationsAlongTheShortestRotation) {
  RobotPose& robot = earlier_.robots[0];
  robot.pose_torso_in_world.translation().x() -= 0.1;
  robot.pose_torso_in_world.rotate(Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitZ()));
  robot.position[3] -= 0.2;
  const WorldState middle = interpolated(earlier_, world_, 0.5);
  EXPECT_EQ(middle.utime, world_.utime - kStep / 2);
  EXPECT_NEAR(middle.robots[0].position[3], world_.robots[0].position[3] - 0.1, 1e-12);
  const Eigen::Isometry3d rest =
      middle.robots[0].pose_torso_in_world.inverse() * world_.robots[0].pose_torso_in_world;
  EXPECT_NEAR(Eigen::AngleAxisd(Eigen::Matrix3d(rest.linear())).angle(), 0.2, 1e-9);
  EXPECT_NEAR(middle.robots[0].pose_torso_in_world.translation().x(),
              world_.robots[0].pose_torso_in_world.translation().x() - 0.05, 1e-12);
  EXPECT_TRUE(interpolated(earlier_, world_, 1)
                  .robots[0]
                  .pose_torso_in_world.isApprox(world_.robots[0].pose_torso_in_world));
}

TEST_F(HeadCameraTest, TheOptionsDefaultToTheFirstCameraOfTheRobot) {
  HeadCameraOptions options;
  EXPECT_EQ(options.camera_name(model_), model_.cameras().front().name);
  EXPECT_NO_THROW(options.validate(model_));
  options.camera = "tail";
  EXPECT_THROW(options.validate(model_), std::exception);
}

}  // namespace
}  // namespace nao::camera
