#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "rendering/egl_context.h"
#include "rendering/gl_objects.h"
#include "rendering/image.h"
#include "rendering/scene_renderer.h"

namespace nao {

/** A context without a screen, and a renderer in it. */
struct Offscreen {
  explicit Offscreen(const RendererOptions& options = {}) : renderer(options) {}

  Image draw(const Scene& scene, const PinholeCamera& camera, const Eigen::Isometry3d& pose) {
    const gl::Framebuffer framebuffer(camera.width, camera.height);
    statistics = renderer.render(scene, camera, pose, framebuffer.id());
    std::vector<uint8_t> pixels;
    framebuffer.read(pixels);
    return image_from_bgrx(camera.width, camera.height, pixels);
  }

  EglContext context;
  SceneRenderer renderer;
  RenderStatistics statistics;
};

/** Pose of a camera at `eye` that looks at `target`, with an upright image. */
inline Eigen::Isometry3d look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d x = (target - eye).normalized();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitZ().cross(x).normalized();
  pose.linear() << x, y, x.cross(y);
  pose.translation() = eye;
  return pose;
}

/** Mean of the three colors, 0 to 255. */
inline double brightness(const Image& image, int u, int v) {
  const uint8_t* pixel = image.at(u, v);
  return (pixel[0] + pixel[1] + pixel[2]) / 3.0;
}

/** Largest difference of the three colors. */
inline int difference(const Image& a, const Image& b, int u, int v) {
  int largest = 0;
  for (int channel = 0; channel < 3; ++channel) {
    largest = std::max(largest, std::abs(a.at(u, v)[channel] - b.at(u, v)[channel]));
  }
  return largest;
}

}  // namespace nao
