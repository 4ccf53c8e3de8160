#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "rendering/mesh.h"

namespace nao {

/** Number that SceneRenderer::add_mesh() returned for a mesh. */
using MeshId = int;

/** A mesh at a place in the world. */
struct MeshInstance {
  MeshId mesh = -1;
  Eigen::Isometry3f pose_in_world = Eigen::Isometry3f::Identity();
  /** Scale along the axes of the mesh, applied before the pose. */
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();
  /** Factor on the color of the mesh; an opacity below 1 makes it translucent. */
  Color tint = Color::Ones();
  bool casts_shadow = true;
};

/** A line of a marking, one pixel wide, unlit. */
struct SceneLine {
  /** m, in the world. */
  Eigen::Vector3f from;
  Eigen::Vector3f to;
  Color color;
};

/** A triangle of a marking, such as a footstep; visible from both sides, unlit. */
struct SceneTriangle {
  /** m, in the world. */
  std::array<Eigen::Vector3f, 3> corners;
  Color color;
};

/** The soccer ball. */
struct SceneBall {
  Eigen::Isometry3f pose_in_world = Eigen::Isometry3f::Identity();
  /** m. */
  float radius = 0.05f;
  /** Albedo of the light and of the dark faces. */
  Eigen::Vector3f hexagons = Eigen::Vector3f::Constant(0.86f);
  float pentagons = 0.012f;
};

/** Content of one image besides the ground, the goals and the sky, which the renderer stores. */
struct Scene {
  std::vector<MeshInstance> instances;
  std::optional<SceneBall> ball;
  /** Markings; hidden by the bodies in front of them. */
  std::vector<SceneLine> lines;
  std::vector<SceneTriangle> triangles;

  void clear() {
    instances.clear();
    ball.reset();
    lines.clear();
    triangles.clear();
  }
};

}  // namespace nao
