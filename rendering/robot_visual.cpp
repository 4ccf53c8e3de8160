#include "rendering/robot_visual.h"

#include "common/error.h"
#include "rendering/mesh_file.h"
#include "rendering/primitives.h"
#include "rendering/scene_renderer.h"

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
      return load_mesh(shape.mesh);
  }
  throw ModelError("shape " + shape.name + " has an unknown kind");
}

}  // namespace

RobotVisual::RobotVisual(const RobotModel& model, SceneRenderer& renderer) : model_(model) {
  for (size_t link = 0; link < model.links().size(); ++link) {
    const Link& description = model.links()[link];
    try {
      for (const Shape& shape : description.visuals) {
        add_shape(renderer, static_cast<int>(link), shape);
      }
    } catch (const Error& error) {
      problems_.push_back(std::string(error.what()) + "; link " + description.name +
                          " is drawn by its collision shapes");
      for (const Shape& shape : description.collisions) {
        if (shape.kind != Shape::Kind::kMesh) add_shape(renderer, static_cast<int>(link), shape);
      }
    }
  }
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
