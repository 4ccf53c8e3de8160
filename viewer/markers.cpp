#include "viewer/markers.h"

#include <algorithm>
#include <cmath>

#include "common/rotation.h"
#include "rendering/primitives.h"
#include "rendering/scene_renderer.h"

namespace nao::viewer {
namespace {

/** Radius of the shaft of an arrow of length 1. */
constexpr float kArrowRadius = 0.03f;
/** Arrows longer than this, m, are not thicker than one of this length. */
constexpr float kMaxArrowWidth = 0.2f;
/** Shorter arrows, m, have no direction and are not drawn. */
constexpr double kMinArrowLength = 1e-4;
constexpr int kDiscSides = 16;

}  // namespace

Markers::Markers(SceneRenderer& renderer)
    : arrow_(renderer.add_mesh(make_arrow(kArrowRadius, Color::Ones()))),
      sphere_(renderer.add_mesh(make_sphere(1, Color::Ones()))) {}

void Markers::add_arrow(Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& tip,
                        const Color& color) const {
  const Eigen::Vector3d along = tip - from;
  if (along.norm() < kMinArrowLength) return;
  MeshInstance arrow;
  arrow.mesh = arrow_;
  arrow.pose_in_world.translate(from.cast<float>());
  // The arrow's mesh points along z and has length 1.
  arrow.pose_in_world.rotate(rotation_between(Eigen::Vector3d::UnitZ(), along).cast<float>());
  const auto length = static_cast<float>(along.norm());
  const float width = std::min(length, kMaxArrowWidth);
  arrow.scale = {width, width, length};
  arrow.tint = color;
  arrow.casts_shadow = false;
  scene.instances.push_back(arrow);
}

void Markers::add_sphere(Scene& scene, const Eigen::Vector3d& center, double radius,
                         const Color& color) const {
  MeshInstance sphere;
  sphere.mesh = sphere_;
  sphere.pose_in_world.translate(center.cast<float>());
  sphere.scale.setConstant(static_cast<float>(radius));
  sphere.tint = color;
  sphere.casts_shadow = false;
  scene.instances.push_back(sphere);
}

void Markers::add_disc(Scene& scene, const Eigen::Vector3d& center, double radius,
                       const Color& color) const {
  const auto rim = [&](int i) {
    const double angle = 2 * M_PI * i / kDiscSides;
    // Horizontal.
    const Eigen::Vector3d offset(radius * std::cos(angle), radius * std::sin(angle), 0);
    return Eigen::Vector3f((center + offset).cast<float>());
  };
  for (int i = 0; i < kDiscSides; ++i) {
    scene.triangles.push_back({{center.cast<float>(), rim(i), rim(i + 1)}, color});
  }
}

void Markers::add_polygon(Scene& scene, const std::vector<Eigen::Vector3d>& corners,
                          const Color& color) const {
  for (const Eigen::Vector3d& corner : corners) {
    if (!corner.allFinite()) return;
  }
  Color edge = color;
  edge.w() = 1;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3f next = corners[(i + 1) % corners.size()].cast<float>();
    scene.lines.push_back({corners[i].cast<float>(), next, edge});
    // A fan of triangles about the first corner.
    if (i == 0 || i + 1 == corners.size()) continue;
    scene.triangles.push_back({{corners[0].cast<float>(), corners[i].cast<float>(), next}, color});
  }
}

}  // namespace nao::viewer
