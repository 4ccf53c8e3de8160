#include "daemons/head-camera/overview.h"

#include <gtest/gtest.h>

#include "daemons/head-camera/head_camera.h"

namespace nao::camera {
namespace {

using Eigen::Vector3d;

/** Pixel of a point of the world. */
Eigen::Vector2d pixel_of(const Vector3d& point, const Eigen::Isometry3d& pose) {
  return pinhole_of(overview_camera()).project(pose.inverse() * point);
}

void expect_visible(const Vector3d& point, const Eigen::Isometry3d& pose) {
  const Eigen::Vector2d pixel = pixel_of(point, pose);
  EXPECT_TRUE(pixel.x() > 0 && pixel.x() < 639 && pixel.y() > 0 && pixel.y() < 479)
      << point.transpose() << " is at pixel " << pixel.transpose();
}

TEST(Overview, ShowsTheWholeFieldAndRobotsAtItsCorners) {
  const SceneFile scene = SceneFile::find("soccer");
  const Eigen::Isometry3d pose = overview_pose(scene.field, {});
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double height : {0.0, 0.6}) {
        expect_visible({x * scene.field->length, y * scene.field->width, height}, pose);
      }
    }
  }
  // Goal 0's end is to the right, and the far side line is above the near one.
  EXPECT_GT(pixel_of({4.5, 0, 0}, pose).x(), 500);
  EXPECT_LT(pixel_of({0, 3, 0}, pose).y(), pixel_of({0, -3, 0}, pose).y() - 100);
}

TEST(Overview, WithoutAFieldShowsTheRobots) {
  WorldState world;
  for (const double x : {10.0, 10.6, 11.2}) {
    world.robots.emplace_back();
    world.robots.back().pose_torso_in_world.translation() = Vector3d(x, -3, 0.3);
  }
  const Eigen::Isometry3d pose = overview_pose(std::nullopt, world);
  for (const RobotPose& robot : world.robots) {
    expect_visible(robot.pose_torso_in_world.translation() + Vector3d(0, 0, 0.3), pose);
    expect_visible(robot.pose_torso_in_world.translation() - Vector3d(0, 0, 0.3), pose);
  }
}

}  // namespace
}  // namespace nao::camera
