#include "rendering/marking_pass.h"

#include "rendering/goal.h"
#include "rendering/mesh_programs.h"

namespace nao {

MarkingPass::MarkingPass() : net_(compile({"net"})), plain_(compile({"plain"})) {}

// The net is the same in every image; its vertices are computed once for a scene.
void MarkingPass::set_surroundings(const SceneFile& scene) {
  net_vertices_.clear();
  if (!scene.field || !scene.goals) return;
  for (const NetCorner& corner : make_nets(*scene.field, *scene.goals)) {
    net_vertices_.push_back({corner.position, {corner.on_net.x(), corner.on_net.y(), 0, 0}});
  }
}

void MarkingPass::draw_nets(const RenderView& view, RenderStatistics& statistics) {
  if (net_vertices_.empty()) return;
  net_.use();
  net_.set("clip_from_world", view.clip_from_world);
  stream_.draw_triangles(net_vertices_);
  ++statistics.num_draws;
}

void MarkingPass::draw_markings(const Scene& scene, const RenderView& view,
                                RenderStatistics& statistics) {
  if (scene.lines.empty() && scene.triangles.empty()) return;
  plain_.use();
  plain_.set("clip_from_world", view.clip_from_world);
  std::vector<gl::StreamBuffer::Vertex> vertices;
  for (const SceneTriangle& triangle : scene.triangles) {
    for (const Eigen::Vector3f& corner : triangle.corners) {
      vertices.push_back({corner, triangle.color});
    }
  }
  // Triangles first: lines are drawn over them.
  stream_.draw_triangles(vertices);
  vertices.clear();
  for (const SceneLine& line : scene.lines) {
    vertices.push_back({line.from, line.color});
    vertices.push_back({line.to, line.color});
  }
  stream_.draw_lines(vertices);
  statistics.num_draws += 2;
}

}  // namespace nao
