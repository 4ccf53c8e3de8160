#include "rendering/mesh_draws.h"

namespace nao {

void MeshDraws::clear() {
  draws_.clear();
  indices_.clear();
}

void MeshDraws::add(const gl::MeshBuffer& buffer, const MeshInstance& instance,
                    const Eigen::Vector4f& from) {
  const Eigen::Isometry3f& pose = instance.pose_in_world;
  Eigen::Vector4f in_mesh;
  in_mesh << (pose.linear().transpose() * (from.head<3>() - from.w() * pose.translation()))
                 .cwiseQuotient(instance.scale),
      from.w();
  const auto first = static_cast<int>(indices_.size());
  buffer.facing().append(in_mesh, indices_);
  const int num_indices = static_cast<int>(indices_.size()) - first;
  if (num_indices > 0) draws_.push_back({instance, &buffer, first, num_indices});
}

void MeshDraws::upload() {
  stream_.set(indices_);
}

}  // namespace nao
