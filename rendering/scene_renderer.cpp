#include "rendering/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/error.h"
#include "rendering/gl_objects.h"
#include "rendering/goal.h"
#include "rendering/primitives.h"
#include "rendering/shaders.h"

namespace nao {
namespace {

/** The nearest thing seen is the robot's own shoulder, a few centimetres from the lens. */
constexpr double kNear = 0.01;
constexpr double kFar = 120;
/** Direction to the lamp: high, to the left of the field, a little towards the goal at +x. */
const Eigen::Vector3f kLightDirection = Eigen::Vector3f(0.18f, 0.42f, 0.85f).normalized();
/** The shadow map grows in steps, so that its edges do not shimmer as bodies move, m. */
constexpr float kShadowStep = 0.05f;
constexpr int kBallSides = 32;
/** Detail of bodies that throw shadows, m: a few texels of one robot's shadow. */
constexpr float kShadowCell = 0.014f;

Eigen::Matrix4f model_matrix(const MeshInstance& instance) {
  Eigen::Matrix4f matrix = instance.pose_in_world.matrix();
  for (int axis = 0; axis < 3; ++axis) matrix.col(axis) *= instance.scale[axis];
  return matrix;
}

/** Turns normals: rotation times the inverse of the stretching. */
Eigen::Matrix4f normal_matrix(const MeshInstance& instance) {
  Eigen::Matrix4f matrix = instance.pose_in_world.matrix();
  for (int axis = 0; axis < 3; ++axis) matrix.col(axis) /= instance.scale[axis];
  return matrix;
}

/** Turns the world so that z points to the lamp. */
Eigen::Matrix3f lamp_rotation() {
  Eigen::Matrix3f lamp_from_world;
  lamp_from_world.row(2) = kLightDirection;
  lamp_from_world.row(0) = Eigen::Vector3f::UnitX().cross(kLightDirection).normalized();
  lamp_from_world.row(1) = lamp_from_world.row(2).cross(lamp_from_world.row(0));
  return lamp_from_world;
}

/** Maps the world to a picture taken from the lamp of everything inside a box that is given in the
 * lamp's axes. */
Eigen::Matrix4f lamp_matrix(const Eigen::AlignedBox3f& box) {
  // Whole steps, so that still bodies keep still shadows while another one moves.
  const Eigen::Vector3f lower = (box.min() / kShadowStep).array().floor() * kShadowStep;
  const Eigen::Vector3f upper = (box.max() / kShadowStep).array().ceil() * kShadowStep;
  const Eigen::Vector3f scale = 2 * (upper - lower).cwiseInverse();
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  matrix.topLeftCorner<3, 3>() = scale.asDiagonal() * lamp_rotation();
  matrix.topRightCorner<3, 1>() = -scale.cwiseProduct((lower + upper) / 2);
  matrix.row(2) *= -1;  // depth grows away from the lamp
  return matrix;
}

/** From clip coordinates, -1 to 1, to texture coordinates, 0 to 1. */
Eigen::Matrix4f texture_from_clip() {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity() * 0.5f;
  matrix.col(3) << 0.5f, 0.5f, 0.5f, 1;
  return matrix;
}

gl::ShaderProgram compile(const std::string& name, const shaders::Source& source) {
  return {name, source.vertex, source.fragment};
}

}  // namespace

class SceneRenderer::Implementation {
 public:
  explicit Implementation(const RendererOptions& options)
      : options_(options),
        solid_(compile("solid", shaders::solid(options.shadow_size > 0))),
        ball_(compile("ball", shaders::ball(options.shadow_size > 0))),
        field_(compile("field", shaders::field(false))),
        floor_(compile("floor", shaders::floor(false))),
        shadowed_field_(compile("shadowed field", shaders::field(true))),
        shadowed_floor_(compile("shadowed floor", shaders::floor(true))),
        sky_(compile("sky", shaders::sky())),
        depth_(compile("depth", shaders::depth())),
        net_(compile("net", shaders::net())),
        plain_(compile("plain", shaders::plain())) {
    if (options.shadow_size > 0) shadow_map_ = std::make_unique<gl::ShadowMap>(options.shadow_size);
    ball_mesh_ = add_mesh(make_sphere(1, Color::Ones(), kBallSides));
  }

  MeshId add_mesh(const Mesh& mesh) {
    meshes_.push_back({std::make_unique<gl::MeshBuffer>(mesh),
                       std::make_unique<gl::MeshBuffer>(simplified(mesh, kShadowCell)),
                       bounding_sphere(mesh)});
    return static_cast<MeshId>(meshes_.size()) - 1;
  }

  void set_surroundings(const SceneFile& scene) {
    surroundings_ = scene;
    goals_.clear();
    net_vertices_.clear();
    if (!scene.field || !scene.goals) return;
    for (const int end : {-1, 1}) {
      const Mesh goal = make_goal(*scene.field, *scene.goals, end);
      goals_.push_back({std::make_unique<gl::MeshBuffer>(goal), nullptr, bounding_sphere(goal)});
    }
    for (const NetCorner& corner : make_nets(*scene.field, *scene.goals)) {
      net_vertices_.push_back({corner.position, {corner.on_net.x(), corner.on_net.y(), 0, 0}});
    }
  }

  RenderStatistics render(const Scene& scene, const PinholeCamera& camera,
                          const Eigen::Isometry3d& pose_camera_in_world, unsigned framebuffer,
                          const std::vector<PixelBox>& covered) {
    statistics_ = {};
    clip_from_world_ = projection_matrix(camera, kNear, kFar) * view_matrix(pose_camera_in_world);
    eye_ = pose_camera_in_world.translation().cast<float>();
    sort(scene, Frustum(clip_from_world_));
    reset_state();
    if (shadow_map_) draw_shadow_map();

    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, camera.width, camera.height);
    glClear(GL_DEPTH_BUFFER_BIT);  // the sky covers what nothing else does
    shut_out(covered);
    draw_solids();
    draw_ground(camera);
    draw_sky();
    draw_translucent(scene);
    glBindVertexArray(0);
    glUseProgram(0);
    return statistics_;
  }

 private:
  struct KeptMesh {
    std::unique_ptr<gl::MeshBuffer> buffer;
    /** Coarser, to throw a shadow; goals have none. */
    std::unique_ptr<gl::MeshBuffer> caster;
    BoundingSphere sphere;
  };

  void reset_state() {
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glActiveTexture(GL_TEXTURE0);
  }

  /** Everything lies behind the least depth, so nothing there is ever shaded. */
  static void shut_out(const std::vector<PixelBox>& boxes) {
    glEnable(GL_SCISSOR_TEST);
    glClearDepth(0);
    for (const PixelBox& box : boxes) {
      if (box.is_empty()) continue;
      glScissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
      glClear(GL_DEPTH_BUFFER_BIT);
    }
    glClearDepth(1);
    glDisable(GL_SCISSOR_TEST);
  }

  BoundingSphere sphere_in_world(const MeshInstance& instance) const {
    const BoundingSphere& sphere = meshes_[instance.mesh].sphere;
    return {instance.pose_in_world * sphere.center.cwiseProduct(instance.scale),
            sphere.radius * instance.scale.cwiseAbs().maxCoeff()};
  }

  /** Picks what this camera may see, and what may throw a shadow there. */
  void sort(const Scene& scene, const Frustum& frustum) {
    opaque_.clear();
    translucent_.clear();
    casters_.clear();
    casters_box_.setEmpty();
    for (const MeshInstance& instance : scene.instances) {
      const BoundingSphere sphere = sphere_in_world(instance);
      const bool is_opaque = instance.tint.w() >= 1;
      if (frustum.may_see(sphere.center, sphere.radius)) {
        (is_opaque ? opaque_ : translucent_).push_back(instance);
      }
      if (is_opaque && instance.casts_shadow) add_caster(instance, sphere, frustum);
    }
    sees_ball_ = false;
    if (!scene.ball) return;
    MeshInstance& ball = ball_instance_;
    ball.mesh = ball_mesh_;
    ball.pose_in_world = scene.ball->pose_in_world;
    ball.scale.setConstant(scene.ball->radius);
    const BoundingSphere sphere = sphere_in_world(ball);
    sees_ball_ = frustum.may_see(sphere.center, sphere.radius);
    add_caster(ball, sphere, frustum);
  }

  void add_caster(const MeshInstance& instance, const BoundingSphere& sphere,
                  const Frustum& frustum) {
    if (!shadow_map_) return;
    // From the body down to where its shadow falls on the ground.
    const float way = std::max(0.0f, sphere.center.z() / kLightDirection.z());
    if (!frustum.may_see(sphere.center, sphere.center - way * kLightDirection, sphere.radius))
      return;
    casters_.push_back(instance);
    const Eigen::Vector3f center = lamp_rotation() * sphere.center;
    casters_box_.extend(Eigen::Vector3f(center.array() - sphere.radius));
    casters_box_.extend(Eigen::Vector3f(center.array() + sphere.radius));
  }

  void draw_shadow_map() {
    glBindFramebuffer(GL_FRAMEBUFFER, shadow_map_->framebuffer());
    glViewport(0, 0, shadow_map_->size(), shadow_map_->size());
    glClear(GL_DEPTH_BUFFER_BIT);
    if (casters_.empty()) {
      // All the world falls outside the map, where it is lit.
      shadow_from_world_ = Eigen::Matrix4f::Zero();
      shadow_from_world_.col(3) << 2, 2, 0, 1;
      return;
    }
    const Eigen::Matrix4f lamp_from_world = lamp_matrix(casters_box_);
    shadow_from_world_ = texture_from_clip() * lamp_from_world;
    // Keeps surfaces from shading themselves where the map is coarser than they are.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(2.0f, 4.0f);
    depth_.use();
    for (const MeshInstance& caster : casters_) {
      draw_depth(*meshes_[caster.mesh].caster, caster, lamp_from_world);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
  }

  void draw_depth(const gl::MeshBuffer& buffer, const MeshInstance& instance,
                  const Eigen::Matrix4f& clip_from_world) {
    depth_.set("clip_from_mesh", Eigen::Matrix4f(clip_from_world * model_matrix(instance)));
    draw(buffer);
  }

  void draw(const gl::MeshBuffer& buffer) {
    buffer.draw();
    ++statistics_.num_draws;
    statistics_.num_triangles += buffer.num_triangles();
  }

  void use_lit(const gl::ShaderProgram& program) {
    program.use();
    program.set("clip_from_world", clip_from_world_);
    program.set("eye_position", eye_);
    program.set("light_direction", kLightDirection);
    if (!shadow_map_) return;
    glBindTexture(GL_TEXTURE_2D, shadow_map_->texture());
    program.set("shadow_map", 0);
    program.set("shadow_from_world", shadow_from_world_);
  }

  void draw_lit(const gl::ShaderProgram& program, const gl::MeshBuffer& buffer,
                const MeshInstance& instance) {
    const Eigen::Matrix4f world_from_mesh = model_matrix(instance);
    program.set("clip_from_mesh", Eigen::Matrix4f(clip_from_world_ * world_from_mesh));
    program.set("world_from_mesh", world_from_mesh);
    program.set("normal_from_mesh", normal_matrix(instance));
    program.set("tint", instance.tint);
    draw(buffer);
  }

  void draw_solids() {
    use_lit(solid_);
    for (const MeshInstance& instance : opaque_) {
      draw_lit(solid_, *meshes_[instance.mesh].buffer, instance);
    }
    const Frustum frustum(clip_from_world_);
    for (const KeptMesh& goal : goals_) {
      if (frustum.may_see(goal.sphere.center, goal.sphere.radius)) {
        draw_lit(solid_, *goal.buffer, MeshInstance());
      }
    }
    if (!sees_ball_) return;
    use_lit(ball_);
    draw_lit(ball_, *meshes_[ball_mesh_].buffer, ball_instance_);
  }

  /** Only where shadows may fall does the ground look them up, since every look-up costs: there
   * with one program, in the four strips around with another. */
  void draw_ground(const PinholeCamera& camera) {
    const PixelBox all{0, 0, camera.width, camera.height};
    const PixelBox shadowed = casters_.empty() ? PixelBox{} : shadow_box(camera);
    const bool is_field = surroundings_.field.has_value();
    glEnable(GL_SCISSOR_TEST);
    if (shadowed.is_empty()) {
      draw_ground(is_field ? field_ : floor_, {all});
    } else {
      draw_ground(is_field ? shadowed_field_ : shadowed_floor_, {shadowed});
      draw_ground(is_field ? field_ : floor_,
                  {{all.left, all.bottom, all.right, shadowed.bottom},
                   {all.left, shadowed.top, all.right, all.top},
                   {all.left, shadowed.bottom, shadowed.left, shadowed.top},
                   {shadowed.right, shadowed.bottom, all.right, shadowed.top}});
    }
    glDisable(GL_SCISSOR_TEST);
  }

  void draw_ground(const gl::ShaderProgram& program, const std::vector<PixelBox>& boxes) {
    use_lit(program);
    program.set("reach", options_.ground_reach);
    if (surroundings_.field) set_field(program, *surroundings_.field);
    for (const PixelBox& box : boxes) {
      if (box.is_empty()) continue;
      glScissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
      nothing_.draw_triangles(6);
      ++statistics_.num_draws;
    }
  }

  /** Pixels around the part of the ground that the shadow map covers. */
  PixelBox shadow_box(const PinholeCamera& camera) const {
    const Eigen::Matrix4f world_from_map = shadow_from_world_.inverse();
    Eigen::Vector2f lower = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
    Eigen::Vector2f upper = -lower;
    for (const auto& [x, y] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 1.0f}}) {
      const Eigen::Vector3f on_ray = (world_from_map * Eigen::Vector4f(x, y, 0, 1)).head<3>();
      const Eigen::Vector3f ground = on_ray - kLightDirection * (on_ray.z() / kLightDirection.z());
      const Eigen::Vector4f clip = clip_from_world_ * ground.homogeneous();
      // A corner behind the camera: the box has no simple bounds.
      if (clip.w() < static_cast<float>(kNear)) return {0, 0, camera.width, camera.height};
      lower = lower.cwiseMin(clip.head<2>() / clip.w());
      upper = upper.cwiseMax(clip.head<2>() / clip.w());
    }
    const auto pixel = [](float in_clip, int size) {
      return std::clamp((in_clip + 1) / 2, 0.0f, 1.0f) * static_cast<float>(size);
    };
    return {static_cast<int>(std::floor(pixel(lower.x(), camera.width))),
            static_cast<int>(std::floor(pixel(lower.y(), camera.height))),
            static_cast<int>(std::ceil(pixel(upper.x(), camera.width))),
            static_cast<int>(std::ceil(pixel(upper.y(), camera.height)))};
  }

  static void set_field(const gl::ShaderProgram& program, const FieldDimensions& field) {
    const auto pair = [](double x, double y) {
      return Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y));
    };
    const double strip = field.border_strip_width;
    program.set("half_field", pair(field.length / 2, field.width / 2));
    program.set("half_carpet", pair(field.length / 2 + strip, field.width / 2 + strip));
    program.set("half_line", static_cast<float>(field.line_width / 2));
    program.set("goal_area", pair(field.goal_area_length, field.goal_area_width / 2));
    program.set("penalty_area", pair(field.penalty_area_length, field.penalty_area_width / 2));
    program.set("penalty_mark",
                pair(field.length / 2 - field.penalty_mark_distance, field.penalty_mark_size / 2));
    program.set("centre", pair(field.centre_circle_diameter / 2, field.centre_mark_length / 2));
  }

  void draw_sky() {
    sky_.use();
    // Seen from the eye, so that a direction comes out whatever the distance.
    Eigen::Matrix4f eye_at_origin = Eigen::Matrix4f::Identity();
    eye_at_origin.topRightCorner<3, 1>() = eye_;
    sky_.set("world_from_clip", Eigen::Matrix4f((clip_from_world_ * eye_at_origin).inverse()));
    nothing_.draw_triangles(3);
    ++statistics_.num_draws;
  }

  void draw_translucent(const Scene& scene) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw_bodies_through();
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    if (!net_vertices_.empty()) {
      net_.use();
      net_.set("clip_from_world", clip_from_world_);
      stream_.draw(GL_TRIANGLES, net_vertices_);
      ++statistics_.num_draws;
    }
    draw_markings(scene);
    glEnable(GL_CULL_FACE);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }

  /** Bodies that one sees through: their nearest surface only, not the parts inside. They stand a
   * little back, so that a solid body in the same place hides them instead of flickering. */
  void draw_bodies_through() {
    if (translucent_.empty()) return;
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(2.0f, 16.0f);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    depth_.use();
    for (const MeshInstance& instance : translucent_) {
      draw_depth(*meshes_[instance.mesh].buffer, instance, clip_from_world_);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    // The two shaders may round depth differently in the last bits.
    glPolygonOffset(1.0f, 8.0f);
    use_lit(solid_);
    for (const MeshInstance& instance : translucent_) {
      draw_lit(solid_, *meshes_[instance.mesh].buffer, instance);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
  }

  void draw_markings(const Scene& scene) {
    if (scene.lines.empty() && scene.triangles.empty()) return;
    plain_.use();
    plain_.set("clip_from_world", clip_from_world_);
    std::vector<gl::StreamBuffer::Vertex> vertices;
    for (const SceneTriangle& triangle : scene.triangles) {
      for (const Eigen::Vector3f& corner : triangle.corners) {
        vertices.push_back({corner, triangle.color});
      }
    }
    stream_.draw(GL_TRIANGLES, vertices);
    vertices.clear();
    for (const SceneLine& line : scene.lines) {
      vertices.push_back({line.from, line.color});
      vertices.push_back({line.to, line.color});
    }
    stream_.draw(GL_LINES, vertices);
    statistics_.num_draws += 2;
  }

  RendererOptions options_;
  gl::ShaderProgram solid_;
  gl::ShaderProgram ball_;
  gl::ShaderProgram field_;
  gl::ShaderProgram floor_;
  gl::ShaderProgram shadowed_field_;
  gl::ShaderProgram shadowed_floor_;
  gl::ShaderProgram sky_;
  gl::ShaderProgram depth_;
  gl::ShaderProgram net_;
  gl::ShaderProgram plain_;
  gl::EmptyVertexArray nothing_;
  gl::StreamBuffer stream_;
  std::unique_ptr<gl::ShadowMap> shadow_map_;
  std::vector<KeptMesh> meshes_;
  MeshId ball_mesh_ = -1;

  SceneFile surroundings_;
  std::vector<KeptMesh> goals_;
  std::vector<gl::StreamBuffer::Vertex> net_vertices_;

  // The picture being drawn.
  Eigen::Matrix4f clip_from_world_ = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f shadow_from_world_ = Eigen::Matrix4f::Identity();
  Eigen::Vector3f eye_ = Eigen::Vector3f::Zero();
  std::vector<MeshInstance> opaque_;
  std::vector<MeshInstance> translucent_;
  std::vector<MeshInstance> casters_;
  Eigen::AlignedBox3f casters_box_;
  MeshInstance ball_instance_;
  bool sees_ball_ = false;
  RenderStatistics statistics_;
};

SceneRenderer::SceneRenderer(const RendererOptions& options) {
  int major = 0;
  int minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor < 33) {
    throw Error("drawing needs OpenGL 3.3, the driver offers " + std::to_string(major) + "." +
                std::to_string(minor));
  }
  implementation_ = std::make_unique<Implementation>(options);
}

SceneRenderer::~SceneRenderer() = default;

MeshId SceneRenderer::add_mesh(const Mesh& mesh) {
  return implementation_->add_mesh(mesh);
}

void SceneRenderer::set_surroundings(const SceneFile& scene) {
  implementation_->set_surroundings(scene);
}

RenderStatistics SceneRenderer::render(const Scene& scene, const PinholeCamera& camera,
                                       const Eigen::Isometry3d& pose_camera_in_world,
                                       unsigned framebuffer, const std::vector<PixelBox>& covered) {
  return implementation_->render(scene, camera, pose_camera_in_world, framebuffer, covered);
}

std::string SceneRenderer::driver() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr ? name : "unknown";
}

}  // namespace nao
