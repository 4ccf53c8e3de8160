#include "rendering/pinhole_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nao {
namespace {

/** An asymmetric camera: principal point off center, pixels not square. */
PinholeCamera asymmetric_camera() {
  return {640, 480, 540, 520, 300.25, 250.75};
}

Eigen::Isometry3d some_pose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(0.3, -1.2, 0.5));
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.2, -0.5, 1).normalized()));
  return pose;
}

TEST(PinholeCamera, SeesItsFieldOfViewFromEdgeToEdge) {
  const double fov = 60.9 * M_PI / 180;
  const auto camera = PinholeCamera::from_fov(640, 480, fov, 47.6 * M_PI / 180);
  EXPECT_NEAR(camera.fx, 544.34, 0.01);  // camera.csv of the V5
  EXPECT_NEAR(camera.fy, 544.15, 0.01);
  // The left edge of the image is half a pixel left of the center of the first pixel.
  const Eigen::Vector2d edge = camera.project({1, std::tan(fov / 2), 0});
  EXPECT_NEAR(edge.x(), -0.5, 1e-9);
  EXPECT_NEAR(edge.y(), 239.5, 1e-9);
}

TEST(PinholeCamera, ProjectsRightAndDown) {
  const auto camera = PinholeCamera::from_fov(640, 480, 1, 0.8);
  EXPECT_GT(camera.project({1, -0.1, 0}).x(), 320);
  EXPECT_GT(camera.project({1, 0, -0.1}).y(), 240);
}

TEST(PinholeCamera, RayLeadsBackToItsPixel) {
  const PinholeCamera camera = asymmetric_camera();
  const Eigen::Vector2d pixel(17.5, 401);
  EXPECT_LT((camera.project(3.2 * camera.ray(pixel)) - pixel).norm(), 1e-9);
}

TEST(PinholeCamera, ResizedHasTheSameFieldOfView) {
  const PinholeCamera camera = asymmetric_camera();
  const PinholeCamera half = camera.resized(320);
  EXPECT_EQ(half.height, 240);
  const Eigen::Vector3d point(2, 0.4, -0.3);
  const Eigen::Vector2d half_pixel(0.5, 0.5);
  EXPECT_LT((2 * (half.project(point) + half_pixel) - (camera.project(point) + half_pixel)).norm(),
            1e-9);
}

TEST(PinholeCamera, MatricesAgreeWithTheFormula) {
  const PinholeCamera camera = asymmetric_camera();
  const Eigen::Isometry3d pose = some_pose();
  const Eigen::Matrix4f clip_from_world = projection_matrix(camera, 0.01, 100) * view_matrix(pose);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> sideways(-0.5, 0.5);
  std::uniform_real_distribution<double> ahead(0.02, 20);
  for (int i = 0; i < 200; ++i) {
    const double depth = ahead(random);
    const Eigen::Vector3d in_camera =
        depth * Eigen::Vector3d(1, sideways(random), sideways(random));
    const Eigen::Vector3d in_world = pose * in_camera;
    const Eigen::Vector4f clip = clip_from_world * in_world.cast<float>().homogeneous();
    // OpenGL: -1 and 1 are the outer edges of the first and last pixels, y up.
    const double u = (clip.x() / clip.w() + 1) / 2 * camera.width - 0.5;
    const double v = (1 - clip.y() / clip.w()) / 2 * camera.height - 0.5;
    const Eigen::Vector2d pixel = camera.project(in_camera);
    // Single precision, and the nearest points lie 2 cm from the lens but 1.3 m from the origin.
    ASSERT_NEAR(u, pixel.x(), 0.02);
    ASSERT_NEAR(v, pixel.y(), 0.02);
    ASSERT_GT(clip.z(), -clip.w());
    ASSERT_LT(clip.z(), clip.w());
  }
}

TEST(Frustum, ContainsExactlyThePointsInTheImage) {
  const PinholeCamera camera = asymmetric_camera();
  const Eigen::Isometry3d pose = some_pose();
  const Frustum frustum(projection_matrix(camera, 0.01, 100) * view_matrix(pose));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  int num_seen = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d in_camera(coordinate(random), coordinate(random), coordinate(random));
    if (std::abs(in_camera.x()) < 0.02) continue;
    const Eigen::Vector2d pixel = camera.project(in_camera);
    const bool inside = in_camera.x() > 0.01 && pixel.x() > -0.5 && pixel.x() < 639.5 &&
                        pixel.y() > -0.5 && pixel.y() < 479.5;
    num_seen += inside ? 1 : 0;
    const Eigen::Vector3f in_world = (pose * in_camera).cast<float>();
    ASSERT_EQ(frustum.may_see(in_world, 0), inside) << in_camera.transpose();
  }
  EXPECT_GT(num_seen, 50);
}

TEST(Frustum, MayContainPartOfASphere) {
  const Frustum frustum(projection_matrix(asymmetric_camera(), 0.01, 100) *
                        view_matrix(Eigen::Isometry3d::Identity()));
  EXPECT_FALSE(frustum.may_see({-0.3f, 0, 0}, 0.25f));
  EXPECT_TRUE(frustum.may_see({-0.3f, 0, 0}, 0.35f));
  EXPECT_FALSE(frustum.may_see({2, 4, 0}, 1));
  EXPECT_TRUE(frustum.may_see({2, 4, 0}, 3));
}

}  // namespace
}  // namespace nao
