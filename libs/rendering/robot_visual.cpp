#include "rendering/robot_visual.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.h"
#include "rendering/mesh_file.h"
#include "rendering/primitives.h"
#include "rendering/scene_renderer.h"
#include "robot_model/robot_lights.h"

namespace nao {
namespace {

/** Light grey plastic. */
const Color kPrimitiveColor(0.62f, 0.62f, 0.64f, 1);

Mesh make_mesh(const Shape& shape) {
  const auto radius = static_cast<float>(shape.radius);
  const auto length = static_cast<float>(shape.length);
  switch (shape.kind) {
    case Shape::Kind::kBox:
      return make_box(shape.size.cast<float>(), kPrimitiveColor);
    case Shape::Kind::kSphere:
      return make_sphere(radius, kPrimitiveColor);
    case Shape::Kind::kCylinder:
      return make_cylinder(radius, length, kPrimitiveColor);
    case Shape::Kind::kCapsule:
      return make_capsule(radius, length, kPrimitiveColor);
    case Shape::Kind::kMesh:
      return shape.is_mirrored ? mirrored(load_mesh(shape.mesh)) : load_mesh(shape.mesh);
  }
  throw ModelError("shape " + shape.name + " has an unknown kind");
}

/** Corners of a light's outline. Chosen: the eye of a robot at 1 m is 8 pixels wide. */
constexpr int kLightSides = 12;

std::vector<std::array<Eigen::Vector3f, 3>> make_triangles(const RobotLight::Disc& disc) {
  const Eigen::Vector3d across = disc.normal.unitOrthogonal();
  const Eigen::Vector3d up = disc.normal.cross(across);
  const auto corner = [&](int side, double radius) -> Eigen::Vector3f {
    const double angle = 2 * std::numbers::pi * side / kLightSides;
    return (disc.center + radius * (std::cos(angle) * across + std::sin(angle) * up)).cast<float>();
  };
  std::vector<std::array<Eigen::Vector3f, 3>> triangles;
  for (int i = 0; i < kLightSides; ++i) {
    triangles.push_back(
        {corner(i, disc.inner_radius), corner(i, disc.radius), corner(i + 1, disc.radius)});
    if (disc.inner_radius <= 0) continue;
    triangles.push_back({corner(i, disc.inner_radius), corner(i + 1, disc.radius),
                         corner(i + 1, disc.inner_radius)});
  }
  return triangles;
}

}  // namespace

RobotVisual::RobotVisual(const RobotModel& model, SceneRenderer& renderer) : model_(model) {
  const bool has_visuals = std::any_of(model.links().begin(), model.links().end(),
                                       [](const Link& link) { return !link.visuals.empty(); });
  for (size_t link = 0; link < model.links().size(); ++link) {
    const Link& description = model.links()[link];
    for (const Shape& shape : description.collisions) {
      if (!has_visuals && shape.kind != Shape::Kind::kMesh) {
        add_shape(renderer, static_cast<int>(link), shape);
      }
    }
    try {
      for (const Shape& shape : description.visuals) {
        add_shape(renderer, static_cast<int>(link), shape);
      }
    } catch (const Error& error) {
      // A mesh that cannot be read must not hide the robot; the caller reports the problem.
      problems_.push_back(std::string(error.what()) + "; link " + description.name +
                          " is drawn by its collision shapes");
      for (const Shape& shape : description.collisions) {
        if (shape.kind != Shape::Kind::kMesh) add_shape(renderer, static_cast<int>(link), shape);
      }
    }
  }
  make_torso_shirt(renderer);
  for (const RobotLight& light : load_robot_lights(model)) {
    LightSurface& surface = lights_.emplace_back(LightSurface{light.name, light.link, {}});
    for (const RobotLight::Disc& disc : light.discs) {
      const auto triangles = make_triangles(disc);
      surface.triangles.insert(surface.triangles.end(), triangles.begin(), triangles.end());
    }
  }
}

void RobotVisual::append_lights(Scene& scene,
                                const std::vector<Eigen::Isometry3d>& link_poses_in_world,
                                const std::vector<LitLight>& lights, int hidden_link) const {
  for (const LitLight& lit : lights) {
    for (const LightSurface& surface : lights_) {
      if (surface.name != lit.name || surface.link == hidden_link) continue;
      const Eigen::Isometry3f pose = link_poses_in_world[surface.link].cast<float>();
      // A dim light is a translucent one: it does not darken what is behind it.
      const float opacity = lit.rgb.maxCoeff();
      if (opacity <= 0) continue;
      Color color;
      color << (lit.rgb / opacity).cwiseAbs2(), opacity;
      for (const auto& triangle : surface.triangles) {
        scene.triangles.push_back(
            {{pose * triangle[0], pose * triangle[1], pose * triangle[2]}, color});
      }
    }
  }
}

void RobotVisual::make_torso_shirt(SceneRenderer& renderer) {
  if (parts_.empty()) return;
  torso_ = parts_.front().link;
  const Link& link = model_.links()[torso_];
  // The shapes that are drawn: visuals, or collision shapes instead of unreadable ones.
  Mesh torso;
  const auto add = [&torso](const Shape& shape) {
    const Eigen::Isometry3f pose = shape.pose_in_link.cast<float>();
    Mesh part = make_mesh(shape);
    for (Vertex& vertex : part.vertices) vertex.position = pose * vertex.position;
    nao::append(torso, part);
  };
  try {
    for (const Shape& shape : link.visuals) add(shape);
  } catch (const Error&) {
    torso = {};
    for (const Shape& shape : link.collisions) {
      if (shape.kind != Shape::Kind::kMesh) add(shape);
    }
  }
  if (torso.indices.empty()) return;
  shirt_ = make_shirt(torso);
  if (!shirt_.band.indices.empty()) shirt_mesh_ = renderer.add_mesh(shirt_.band);
}

void RobotVisual::append_shirt(Scene& scene,
                               const std::vector<Eigen::Isometry3d>& link_poses_in_world, int team,
                               int number, int hidden_link) const {
  if (shirt_mesh_ < 0 || torso_ == hidden_link) return;
  MeshInstance instance;
  instance.mesh = shirt_mesh_;
  instance.pose_in_world = link_poses_in_world[torso_].cast<float>();
  instance.tint = shirt_color(team);
  instance.casts_shadow = false;
  scene.instances.push_back(instance);
  append_number(scene, shirt_, instance.pose_in_world, number);
}

void RobotVisual::add_shape(SceneRenderer& renderer, int link, const Shape& shape) {
  parts_.push_back({link, renderer.add_mesh(make_mesh(shape)), shape.pose_in_link.cast<float>()});
}

void RobotVisual::append(Scene& scene, const std::vector<Eigen::Isometry3d>& link_poses_in_world,
                         const Color& tint, int hidden_link) const {
  for (const Part& part : parts_) {
    if (part.link == hidden_link) continue;
    MeshInstance instance;
    instance.mesh = part.mesh;
    instance.pose_in_world = link_poses_in_world[part.link].cast<float>() * part.pose_in_link;
    instance.tint = tint;
    scene.instances.push_back(instance);
  }
}

std::vector<Eigen::Isometry3d> link_poses_in_world(const RobotModel& model,
                                                   const Eigen::Isometry3d& pose_torso_in_world,
                                                   const std::vector<double>& position) {
  std::vector<Eigen::Isometry3d> poses = model.link_poses(position);
  for (Eigen::Isometry3d& pose : poses) pose = pose_torso_in_world * pose;
  return poses;
}

// The link whose shapes stand in front of a camera on `link`: frames of cameras have none of their
// own, and are fixed to the head.
int carrying_link(const RobotModel& model, int link) {
  int carrier = link;
  while (model.links()[carrier].visuals.empty()) {
    const int joint = model.links()[carrier].parent_joint;
    if (joint < 0 || model.joints()[joint].kind != Joint::Kind::kFixed) return link;
    carrier = model.joints()[joint].parent_link;
  }
  return carrier;
}

}  // namespace nao
