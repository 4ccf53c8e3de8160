#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "rendering/mesh.h"

namespace nao {

/** Number that SceneRenderer::add_mesh() gave a mesh. */
using MeshId = int;

/** One mesh standing somewhere. */
struct MeshInstance {
  MeshId mesh = -1;
  Eigen::Isometry3f pose_in_world = Eigen::Isometry3f::Identity();
  /** Stretches the mesh along its own axes before it is posed. */
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();
  /** Multiplies the mesh's own colour. Below 1, the last one makes it translucent. */
  Color tint = Color::Ones();
  bool casts_shadow = true;
};

/** A straight line for people, drawn one pixel wide. */
struct SceneLine {
  /** m, in the world. */
  Eigen::Vector3f from;
  Eigen::Vector3f to;
  Color color;
};

/** A flat piece of a marking for people, such as a footprint; seen from both sides, unlit. */
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
};

/** What one picture shows besides the ground, goals and sky, which the renderer keeps. */
struct Scene {
  std::vector<MeshInstance> instances;
  std::optional<SceneBall> ball;
  /** Hidden behind solids. */
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
