#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "daemons/head-camera/lens.h"
#include "rendering/egl_context.h"
#include "rendering/gl_objects.h"
#include "rendering/robot_visual.h"
#include "rendering/scene_renderer.h"
#include "tools/vision-dataset/random_scene.h"
#include "tools/vision-eval/image_labels.h"

namespace nao::vision {

/** Renders random scenes, and a second image of each in which colors name the objects, from which
 * the labels are made. */
class DatasetRenderer {
 public:
  /** @param model, field  Must outlive this. @throws Error  if there is no OpenGL driver. */
  DatasetRenderer(const RobotModel& model, const SceneFile& field);

  /** @param labels  Filled, without the file name. @return The image, blue first. */
  cv::Mat render(const RandomScene& scene, LabelledImage& labels);

 private:
  cv::Mat draw(const RandomScene& scene, const camera::Lens& lens, bool has_named_colors);
  void append_robots(const RandomScene& scene, bool has_named_colors);
  void append_distractors(const RandomScene& scene, bool has_named_colors);

  const RobotModel& model_;
  const SceneFile& field_;
  EglContext context_;
  SceneRenderer renderer_;
  RobotVisual visual_;
  gl::Framebuffer framebuffer_;
  /** Box, cylinder and sphere of size 1. */
  std::array<MeshId, 3> shapes_;
  Scene scene_;
};

}  // namespace nao::vision
