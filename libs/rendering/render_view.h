#pragma once

#include <Eigen/Geometry>

#include "rendering/pinhole_camera.h"
#include "rendering/scene_appearance.h"

namespace nao {

/** Distance of the near plane, m: the nearest object in a head camera's view is the robot's own
 * shoulder, a few centimetres from the lens. */
inline constexpr double kNearPlane = 0.01;
/** Distance of the far plane, m. Chosen: twice the default reach of the ground, whose far end haze
 * hides. */
inline constexpr double kFarPlane = 120;

/** The camera of the image that is being drawn, in OpenGL's terms. */
struct RenderView {
  /** @param pose_camera_in_world  Camera axes: x along the view, y left, z up. */
  RenderView(const PinholeCamera& camera, const Eigen::Isometry3d& pose_camera_in_world,
             const SceneAppearance& look = {})
      : width(camera.width),
        height(camera.height),
        clip_from_world(projection_matrix(camera, kNearPlane, kFarPlane) *
                        view_matrix(pose_camera_in_world)),
        eye(pose_camera_in_world.translation().cast<float>()),
        pixels_per_radian(static_cast<float>(camera.fx)),
        frustum(clip_from_world),
        appearance(look) {}

  /** Image size, pixels. */
  int width;
  int height;
  Eigen::Matrix4f clip_from_world;
  /** Center of projection in the world, m. */
  Eigen::Vector3f eye;
  /** Focal length: size in the image, pixels, of an angle of 1 rad at its center. */
  float pixels_per_radian;
  /** The visible part of space. */
  Frustum frustum;
  /** Light and materials. */
  SceneAppearance appearance;
};

}  // namespace nao
