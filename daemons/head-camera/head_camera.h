#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemons/head-camera/exposure.h"
#include "daemons/head-camera/head_camera_options.h"
#include "daemons/head-camera/lens.h"
#include "daemons/head-camera/picture_noise.h"
#include "rendering/egl_context.h"
#include "rendering/gl_objects.h"
#include "rendering/robot_visual.h"
#include "rendering/scene_renderer.h"
#include "rendering/world_state.h"
#include "robot_model/robot_model.h"

namespace nao {

/** What a head camera saw: one picture in its three sizes. */
struct CameraFrame {
  /** Robot time of the state shown, microseconds. */
  int64_t utime = 0;
  /** "top" or "bottom". */
  std::string camera;
  /** Of the largest picture. */
  PinholeCamera pinhole;
  /** Brown-Conrady coefficients k1, k2, p1, p2, k3. */
  std::array<double, 5> distortion{};
  /** s. */
  double exposure_time = 0;
  Eigen::Isometry3d pose_camera_in_world = Eigen::Isometry3d::Identity();
  /** 640x480, 320x240, 160x120: rows from the bottom up, 4 bytes a pixel (blue, green, red, 255).
   */
  std::array<std::vector<uint8_t>, 3> bgrx;

  /** Index into bgrx for a width of 640, 320 or 160. */
  static int level(int width) { return width == 640 ? 0 : width == 320 ? 1 : 2; }
};

/** The robot's two head cameras: from a state of the world to what they see of it. Knows no bus and
 * no clock. Each robot of the world looks like the one of the model. */
class HeadCamera {
 public:
  /** Opens a graphics context of its own, which stays current in this thread.
   * @param model  Must outlive this.
   * @throws Error  if there is no way to draw. */
  HeadCamera(const RobotModel& model, const HeadCameraOptions& options);

  /** Draws what a camera sees into the frame that last_frame() tells of.
   * @param camera  "top" or "bottom".
   * @param least_width  Smaller sizes than this are left out.
   * @param earlier  A state shortly before, from which the exposure's movement follows; nullptr if
   * none is known.
   * @throws Error  if the own robot is not in the world or has no such camera. */
  const CameraFrame& take(const WorldState& world, const std::string& camera, int least_width,
                          const WorldState* earlier = nullptr);

  /** The parts of take(), for measuring them: drawing alone, reading back, the smaller sizes. */
  void draw(const WorldState& world, const std::string& camera);
  void read_back();
  void make_smaller(int least_width);

  const CameraFrame& frame() const { return frame_; }

  /** Way to the graphics driver and its name, for the log. */
  std::string driver() const;
  /** Meshes that are missing, scenes that are unknown: one sentence each, told once. */
  std::vector<std::string> take_problems();

 private:
  void set_scene(const std::string& name);
  void expose(const WorldState& earlier, const WorldState& world, const std::string& camera);
  void bend();

  const RobotModel& model_;
  HeadCameraOptions options_;
  EglContext context_;
  SceneRenderer renderer_;
  RobotVisual visual_;
  gl::Framebuffer framebuffer_;
  /** For each camera; none without distortion. */
  std::map<std::string, Lens> lenses_;
  std::optional<PictureNoise> noise_;
  Exposure exposure_;
  std::vector<uint8_t> bent_;
  Scene scene_;
  SceneFile scene_file_;
  std::optional<std::string> scene_name_;
  std::vector<std::string> problems_;
  CameraFrame frame_;
};

}  // namespace nao
