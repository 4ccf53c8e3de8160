#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "daemons/head-camera/exposure.h"
#include "daemons/head-camera/head_camera_options.h"
#include "daemons/head-camera/image_noise.h"
#include "daemons/head-camera/lens.h"
#include "rendering/egl_context.h"
#include "rendering/gl_objects.h"
#include "rendering/robot_visuals.h"
#include "rendering/scene_renderer.h"
#include "rendering/scene_surroundings.h"
#include "rendering/world_state.h"
#include "robot_model/robot_model.h"

namespace nao::camera {

/** An image of a head camera in three sizes. */
struct CameraFrame {
  /** Robot time at mid exposure, microseconds. */
  int64_t utime = 0;
  /** Number of images that the source has computed: as long as it stays, so do the pixels. */
  int64_t num_changes = 0;
  /** Camera name from the robot's description. */
  std::string camera;
  /** Intrinsics of the largest size. */
  PinholeCamera pinhole;
  Distortion distortion;
  /** s; 0: the image shows one instant. */
  double exposure_time = 0;
  /** 640x480, 320x240, 160x120: rows from the bottom up, 4 bytes a pixel (blue, green, red, 255).
   */
  std::array<std::vector<uint8_t>, 3> bgrx;

  /** Index into bgrx of the width 640, 320 or 160. */
  static int level(int width) { return width == 640 ? 0 : width == 320 ? 1 : 2; }
};

/** Intrinsics of a camera's images of kFullWidth x kFullHeight. */
PinholeCamera pinhole_of(const CameraModel& camera);

/** The robot's head cameras, and the overview of its world: computes images from states of the
 * world. It uses neither the bus nor a clock. */
class HeadCamera {
 public:
  /** Opens its own graphics context, which stays current in this thread.
   * @param model  Must outlive this.
   * @throws Error  if there is no OpenGL driver. @throws ConfigError  if the distortion folds the
   *   image over itself. */
  HeadCamera(const RobotModel& model, const HeadCameraOptions& options);

  /** Computes the image of one camera, which frame() returns, too. Where nothing moves, and without
   * exposure and noise, the pixels stay what they are.
   * @param camera  Name of a camera of the robot, or kOverviewCamera: without lens distortion,
   * exposure and noise, even if the robot is not in the world.
   * @param min_width  Sizes below this width are not computed.
   * @param earlier  A state shortly before `world`, from which the motion during the exposure is
   *   interpolated; nullptr if there is none: the image is then not blurred, and its exposure time
   *   is 0.
   * @throws Error  if the robot, whose camera it is, is not in the world or has no such camera. */
  const CameraFrame& take(const WorldState& world, const std::string& camera, int min_width,
                          const WorldState* earlier = nullptr);

  /** The steps of take(), public so that they can be measured: drawing, reading back, the smaller
   * sizes. */
  void draw(const WorldState& world, const std::string& camera);
  void read_back();
  void make_smaller(int min_width);

  const CameraFrame& frame() const { return frame_; }

  /** Graphics driver and EGL platform, for the log. */
  std::string driver() const;
  /** Meshes and scenes that could not be loaded, one sentence each; each is returned once. */
  std::vector<std::string> take_problems();

 private:
  /** Whether an image of this camera is blurred by motion. */
  bool is_exposed(const std::string& camera, const WorldState& world,
                  const WorldState* earlier) const;
  void expose(const WorldState& earlier, const WorldState& world, const std::string& camera);
  void distort();

  const RobotModel& model_;
  HeadCameraOptions options_;
  EglContext context_;
  SceneRenderer renderer_;
  RobotVisuals visuals_;
  SceneSurroundings surroundings_;
  gl::Framebuffer framebuffer_;
  /** Lens of each camera name; empty without distortion. */
  std::map<std::string, Lens> lenses_;
  std::optional<ImageNoise> noise_;
  Exposure exposure_;
  std::vector<uint8_t> distorted_;
  Scene scene_;
  /** The world that frame_ shows, if the same one would look the same again. */
  std::optional<WorldState> shown_;
  /** Least width that frame_ has, pixels. */
  int least_width_ = 0;
  std::vector<std::string> problems_;
  /** Number of visuals_.problems() that take_problems() has returned. */
  size_t num_told_problems_ = 0;
  CameraFrame frame_;
};

}  // namespace nao::camera
