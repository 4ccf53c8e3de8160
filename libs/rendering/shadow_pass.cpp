#include "rendering/shadow_pass.h"

#include <algorithm>

#include "rendering/gl.h"

namespace nao {
namespace {

/** The edges of the shadow map's box move in multiples of this, m, so that the texels keep their
 * places, and edges of shadows do not flicker, while a body moves. Chosen: about a tenth of the
 * robot's height. */
constexpr float kBoxStep = 0.05f;
/** Margin of the map around the casters, m: two texels of the head camera's map when it covers a
 * whole field (12 m over 320 texels). */
constexpr float kMargin = 0.075f;
/** Depth offset of casters (glPolygonOffset's factor and units). It keeps surfaces from shadowing
 * themselves where the map is coarser than they are. Chosen between stripes on curved surfaces
 * (smaller values) and shadows detached from the feet (larger values). */
constexpr float kOffsetFactor = 2.0f;
constexpr float kOffsetUnits = 4.0f;
/** Least extent of a texel, m. Chosen: about half of the casters' error, as finer ones show no
 * more, and a part of kBoxStep. */
constexpr float kLeastTexel = kBoxStep / 8;
/** Width of a shadow's edge, m: a texel of the map, and the caster's error. */
constexpr float kPenumbra = 0.02f;

/** Rotation into the axes of the light: z points to the light. */
// x of the light's axes is across the light and the world's x; the light is never along x
// (SceneAppearance: from above).
Eigen::Matrix3f light_from_world(const Eigen::Vector3f& light) {
  Eigen::Matrix3f rotation;
  rotation.row(2) = light;
  rotation.row(0) = Eigen::Vector3f::UnitX().cross(light).normalized();
  rotation.row(1) = rotation.row(2).cross(rotation.row(0));
  return rotation;
}

/** The box that the map shows of casters in a box, m, both in the axes of the light. */
Eigen::AlignedBox3f shown_box(const Eigen::AlignedBox3f& casters) {
  // Snapped outwards to multiples of kBoxStep. The casters leave a margin, so that the texels at
  // the map's edge are empty: points outside of the map take their value.
  return {((casters.min().array() - kMargin) / kBoxStep).floor() * kBoxStep,
          ((casters.max().array() + kMargin) / kBoxStep).ceil() * kBoxStep};
}

/** Orthographic projection along the light of everything inside a box.
 * @param box  m, in the axes of the light. @param light  Unit vector towards it. @return Clip
 * coordinates from world coordinates. */
Eigen::Matrix4f light_projection(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& light) {
  const Eigen::Vector3f scale = 2 * box.sizes().cwiseInverse();
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  matrix.topLeftCorner<3, 3>() = scale.asDiagonal() * light_from_world(light);
  matrix.topRightCorner<3, 1>() = -scale.cwiseProduct(box.center());
  matrix.row(2) *= -1;  // depth grows away from the light
  return matrix;
}

/** From clip coordinates, -1 to 1, to texture coordinates and depth, 0 to 1.
 * @param used  Parts of the texture's width and height that the map takes. */
Eigen::Matrix4f texture_from_clip(const Eigen::Vector2f& used) {
  Eigen::Vector4f half(used.x() / 2, used.y() / 2, 0.5f, 1);
  Eigen::Matrix4f matrix = half.asDiagonal();
  matrix.col(3) = half;
  return matrix;
}

}  // namespace

ShadowPass::ShadowPass(int size, const MeshStore& meshes, const DepthProgram& depth)
    : meshes_(meshes), depth_(depth) {
  if (size > 0) map_.emplace(size);
}

void ShadowPass::clear(const Eigen::Vector3f& light) {
  light_ = light;
  casters_.clear();
  casters_box_.setEmpty();
}

void ShadowPass::add_caster(const MeshInstance& instance, const RenderView& view) {
  if (!map_) return;
  const BoundingSphere sphere = meshes_.sphere_in_world(instance);
  // The body and its shadow lie on the segment from the body along the light to the ground z = 0.
  const float distance = std::max(0.0f, sphere.center.z() / light_.z());
  if (!view.frustum.may_see(sphere.center, sphere.center - distance * light_, sphere.radius)) {
    return;
  }
  casters_.push_back(instance);
  // Box of the caster in the light's axes, around its sphere.
  const Eigen::Vector3f center = light_from_world(light_) * sphere.center;
  casters_box_.extend(Eigen::Vector3f(center.array() - sphere.radius));
  casters_box_.extend(Eigen::Vector3f(center.array() + sphere.radius));
}

bool ShadowPass::may_shadow(const BoundingSphere& sphere) const {
  return std::any_of(casters_.begin(), casters_.end(), [&](const MeshInstance& caster) {
    const BoundingSphere source = meshes_.sphere_in_world(caster);
    const Eigen::Vector3f way = sphere.center - source.center;
    const float along = std::max(0.0f, -way.dot(light_));  // away from the light
    return (way + along * light_).norm() < sphere.radius + source.radius;
  });
}

void ShadowPass::draw(RenderStatistics& statistics) {
  if (!map_) return;
  glBindFramebuffer(GL_FRAMEBUFFER, map_->framebuffer());
  glClear(GL_DEPTH_BUFFER_BIT);
  if (casters_.empty()) {
    // Maps every point outside the texture, where nothing is in shadow.
    shadow_from_world_ = Eigen::Matrix4f::Zero();
    shadow_from_world_.col(3) << 2, 2, 0, 1;
    return;
  }
  const Eigen::AlignedBox3f box = shown_box(casters_box_);
  const Eigen::Vector2f num_texels = (box.sizes().head<2>() / kLeastTexel).array().round();
  const Eigen::Vector2i size = num_texels.cast<int>().cwiseMin(map_->size());
  glViewport(0, 0, size.x(), size.y());
  const Eigen::Matrix4f clip_from_world = light_projection(box, light_);
  shadow_from_world_ =
      texture_from_clip(size.cast<float>() / static_cast<float>(map_->size())) * clip_from_world;
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(kOffsetFactor, kOffsetUnits);
  draws_.clear();
  const Eigen::Vector4f from(light_.x(), light_.y(), light_.z(), 0);
  for (const MeshInstance& caster : casters_) {
    draws_.add(meshes_.shape(caster, kCasterError), caster, from);
  }
  draws_.upload();
  depth_.draw(draws_, clip_from_world, statistics);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void ShadowPass::set_uniforms(const gl::ShaderProgram& program) const {
  if (!map_) return;
  glBindTexture(GL_TEXTURE_2D, map_->texture());
  program.set("shadow_map", 0);
  program.set("shadow_from_world", shadow_from_world_);
}

// The shadow of a sphere on the ground is an ellipse, longer along the light; the square around the
// circle of its longer half axis encloses it.
std::vector<PixelBox> ShadowPass::shadowed_pixels(const RenderView& view) const {
  std::vector<PixelBox> boxes;
  for (const MeshInstance& caster : casters_) {
    const BoundingSphere sphere = meshes_.sphere_in_world(caster);
    const Eigen::Vector3f center = sphere.center - light_ * (sphere.center.z() / light_.z());
    const Eigen::Vector2f half =
        Eigen::Vector2f::Constant((sphere.radius + kPenumbra) / light_.z());
    PixelBox box = ground_pixels({center.head<2>() - half, center.head<2>() + half}, view);
    if (box.is_empty()) continue;
    // Boxes that overlap become one, which may overlap others.
    for (size_t i = 0; i < boxes.size();) {
      if (!overlap(box, boxes[i])) {
        ++i;
        continue;
      }
      box = united(box, boxes[i]);
      boxes.erase(boxes.begin() + static_cast<long>(i));
      i = 0;
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace nao
