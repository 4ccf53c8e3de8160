#include "rendering/body_pass.h"

#include <algorithm>

#include "rendering/gl.h"
#include "rendering/goal.h"
#include "rendering/primitives.h"

namespace nao {
namespace {

/** Sides of the ball's mesh. Chosen: its outline deviates from a circle by 0.5 % of the radius. */
constexpr int kBallSides = 32;
/** Largest error of a body's surface in the image, pixels. Chosen: at 1 pixel no difference
 * is visible beside the whole mesh. */
constexpr float kMostErrorPixels = 1;

}  // namespace

BodyPass::BodyPass(MeshStore& meshes, const DepthProgram& depth, bool with_shadow)
    : meshes_(meshes),
      depth_(depth),
      solid_("solid", shaders::solid(with_shadow)),
      ball_("ball", shaders::ball(with_shadow)),
      ball_mesh_(meshes.add(make_sphere(1, Color::Ones(), kBallSides))) {}

void BodyPass::set_surroundings(const SceneFile& scene) {
  goals_.clear();
  if (!scene.field || !scene.goals) return;
  for (const int end : {-1, 1}) {
    const Mesh goal = make_goal(*scene.field, *scene.goals, end);
    goals_.push_back({std::make_unique<gl::MeshBuffer>(goal), bounding_sphere(goal)});
  }
}

// Sorts the instances of this image by pass: what the camera cannot see is left out (view frustum
// culling with bounding spheres). A body outside of the image may still cast a shadow into it, so
// that casters are selected on their own.
void BodyPass::select(const Scene& scene, const RenderView& view, ShadowPass& shadows) {
  opaque_.clear();
  translucent_.clear();
  shadows.clear(view.appearance.light_direction);
  const auto is_visible = [&](const MeshInstance& instance) {
    const BoundingSphere sphere = meshes_.sphere_in_world(instance);
    return view.frustum.may_see(sphere.center, sphere.radius);
  };
  for (const MeshInstance& instance : scene.instances) {
    const bool is_opaque = instance.tint.w() >= 1;
    if (is_visible(instance)) (is_opaque ? opaque_ : translucent_).push_back(instance);
    if (is_opaque && instance.casts_shadow) shadows.add_caster(instance, view);
  }
  is_ball_visible_ = false;
  if (!scene.ball) return;
  ball_instance_.mesh = ball_mesh_;
  ball_instance_.pose_in_world = scene.ball->pose_in_world;
  ball_instance_.scale.setConstant(scene.ball->radius);
  is_ball_visible_ = is_visible(ball_instance_);
  shadows.add_caster(ball_instance_, view);
}

const gl::MeshBuffer& BodyPass::buffer(const MeshInstance& instance, const RenderView& view) const {
  const BoundingSphere sphere = meshes_.sphere_in_world(instance);
  const float distance = std::max(0.0f, (sphere.center - view.eye).norm() - sphere.radius);
  return meshes_.buffer(instance, kMostErrorPixels * distance / view.pixels_per_radian);
}

void BodyPass::draw_opaque(const RenderView& view, const ShadowPass& shadows,
                           RenderStatistics& statistics) {
  // One use() for all instances: only the matrices change from one to the next.
  solid_.use(view, shadows);
  for (const MeshInstance& instance : opaque_) {
    solid_.draw(buffer(instance, view), instance, view, statistics);
  }
  for (const Goal& goal : goals_) {
    if (view.frustum.may_see(goal.sphere.center, goal.sphere.radius)) {
      solid_.draw(*goal.buffer, MeshInstance(), view, statistics);
    }
  }
  if (!is_ball_visible_) return;
  ball_.use(view, shadows);
  ball_.draw(buffer(ball_instance_, view), ball_instance_, view, statistics);
}

void BodyPass::draw_translucent(const RenderView& view, const ShadowPass& shadows,
                                RenderStatistics& statistics) {
  if (translucent_.empty()) return;
  // First the depth alone, then the color of what has that depth: the nearest surface. The depth
  // offset moves the bodies back a little, so that an opaque body in the same place hides them
  // instead of flickering.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2.0f, 16.0f);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  depth_.use();
  for (const MeshInstance& instance : translucent_) {
    depth_.draw(buffer(instance, view), instance, view.clip_from_world, statistics);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  // A smaller offset than before, since the two shaders may round the depth differently.
  glPolygonOffset(1.0f, 8.0f);
  solid_.use(view, shadows);
  for (const MeshInstance& instance : translucent_) {
    solid_.draw(buffer(instance, view), instance, view, statistics);
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace nao
