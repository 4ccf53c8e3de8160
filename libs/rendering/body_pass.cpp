#include "rendering/body_pass.h"

#include <algorithm>

#include "rendering/gl.h"
#include "rendering/goal.h"
#include "rendering/primitives.h"

namespace nao {
namespace {

/** Sides of the ball's mesh. Chosen: its outline deviates from a circle by 0.5 % of the radius. */
constexpr int kBallSides = 32;
/** Largest error of a body's surface in the image, pixels. Chosen: the largest distance of any
 * vertex, which most of the surface is far below; at 2 pixels the NAO's colored parts change
 * visibly. */
constexpr float kMostErrorPixels = 1.4f;
/** Shadows on bodies are looked up at the vertices only where the error of a caster's outline is
 * smaller than this in the image, pixels: beyond 0.8 m for the head camera. Chosen: there a shadow
 * on a robot has the same place and size as with looking it up at each pixel, and a softer outline.
 */
constexpr float kSoftShadowPixels = 8;

float soft_shadow_distance(const RenderView& view) {
  return view.pixels_per_radian * kCasterError / kSoftShadowPixels;
}

std::vector<std::string> defines(bool with_shadow, std::vector<std::string> others = {}) {
  if (with_shadow) others.emplace_back("WITH_SHADOW");
  return others;
}

}  // namespace

BodyPass::BodyPass(MeshStore& meshes, const DepthProgram& depth, bool with_shadow)
    : meshes_(meshes),
      depth_(depth),
      near_program_({"lighting", "mesh", "solid"}, defines(with_shadow, {"SHADOW_AT_PIXELS"})),
      far_program_({"lighting", "mesh", "solid"}, defines(with_shadow)),
      ball_program_({"lighting", "mesh", "ball"}, defines(with_shadow)),
      ball_mesh_(meshes.add(make_sphere(1, Color::Ones(), kBallSides))) {}

void BodyPass::set_surroundings(const SceneFile& scene) {
  goals_.clear();
  if (!scene.field || !scene.goals) return;
  for (const int end : {-1, 1}) {
    const Mesh goal = make_goal(*scene.field, *scene.goals, end);
    goals_.push_back({std::make_unique<gl::MeshBuffer>(goal), bounding_sphere(goal)});
  }
}

// Sorts the instances of this image by pass and leaves out those that the camera cannot see (view
// frustum culling with bounding spheres). A body outside the image may still cast a shadow into it,
// so that casters are selected separately.
void BodyPass::select(const Scene& scene, const RenderView& view, ShadowPass& shadows) {
  near_.clear();
  far_.clear();
  translucent_.clear();
  ball_.clear();
  shadows.clear(view.appearance.light_direction);
  for (const MeshInstance& instance : scene.instances) {
    const bool is_opaque = instance.tint.w() >= 1;
    if (is_opaque && instance.casts_shadow) shadows.add_caster(instance, view);
    const bool is_far = distance(instance, view) > soft_shadow_distance(view);
    add(instance, view, !is_opaque ? translucent_ : is_far ? far_ : near_);
  }
  if (scene.ball) {
    MeshInstance ball;
    ball.mesh = ball_mesh_;
    ball.pose_in_world = scene.ball->pose_in_world;
    ball.scale.setConstant(scene.ball->radius);
    ball.tint << scene.ball->hexagons, scene.ball->pentagons;
    shadows.add_caster(ball, view);
    add(ball, view, ball_);
  }
  // The triangles of goals are too long for shadows at their corners.
  for (const Goal& goal : goals_) {
    if (!view.frustum.may_see(goal.sphere.center, goal.sphere.radius)) continue;
    MeshDraws& draws = shadows.may_shadow(goal.sphere) ? near_ : far_;
    draws.add(*goal.buffer, MeshInstance(), view.eye.homogeneous());
  }
  for (MeshDraws* draws : {&near_, &far_, &translucent_, &ball_}) draws->upload();
}

float BodyPass::distance(const MeshInstance& instance, const RenderView& view) const {
  const BoundingSphere sphere = meshes_.sphere_in_world(instance);
  return std::max(0.0f, (sphere.center - view.eye).norm() - sphere.radius);
}

void BodyPass::add(const MeshInstance& instance, const RenderView& view, MeshDraws& draws) const {
  const BoundingSphere sphere = meshes_.sphere_in_world(instance);
  if (!view.frustum.may_see(sphere.center, sphere.radius)) return;
  const float error = kMostErrorPixels * distance(instance, view) / view.pixels_per_radian;
  draws.add(meshes_.buffer(instance, error), instance, view.eye.homogeneous());
}

void BodyPass::draw_opaque(const RenderView& view, const ShadowPass& shadows,
                           RenderStatistics& statistics) {
  near_program_.draw(near_, view, shadows, statistics);
  far_program_.draw(far_, view, shadows, statistics);
  ball_program_.draw(ball_, view, shadows, statistics);
}

void BodyPass::draw_translucent(const RenderView& view, const ShadowPass& shadows,
                                RenderStatistics& statistics) {
  if (translucent_.draws().empty()) return;
  // Draws first the depth alone, then the color of the surface at that depth, which is the nearest.
  // The depth offset moves the bodies back a little, so that an opaque body in the same place hides
  // them instead of flickering.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2.0f, 16.0f);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  depth_.draw(translucent_, view.clip_from_world, statistics);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  // A smaller offset than before, since the two shaders may round the depth differently.
  glPolygonOffset(1.0f, 8.0f);
  near_program_.draw(translucent_, view, shadows, statistics);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace nao
