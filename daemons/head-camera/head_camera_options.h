#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemons/head-camera/distortion.h"

namespace nao {
class RobotModel;
}

namespace nao::camera {

/** Options of nao-head-camera. */
struct HeadCameraOptions {
  /** "rendered" or "v4l2". */
  std::string source = "rendered";
  /** Devices of the source v4l2, CAMERA=FILE; empty: those of the robot's files. */
  std::vector<std::string> devices;
  /** Port at which the first camera's images are served to programs made for Webots. */
  std::optional<uint16_t> webots_port;
  /** Robot that carries the camera, by its name in WORLD_TRUTH. */
  std::string robot = "NAO";
  /** Send images although none are requested, of the camera, width and rate below. */
  bool always = false;
  /** Camera name; empty: the first camera of the robot's description. */
  std::string camera;
  /** Pixels: 640, 320 or 160. */
  int width = 640;
  /** Images a second, 1 to 30. */
  double rate = 30;
  /** JPEG quality of requests that give none, 1 to 95. */
  int quality = 80;
  /** Side of the shadow map, texels; 0: no shadows. */
  int shadow_size = 320;
  /** Imperfections of a real camera; 0: none. Lens distortion. */
  Distortion distortion;
  /** Standard deviation of the noise of each color, of 255 levels. */
  double noise = 0;
  /** Exposure time, s; it ends at the time of the state that is drawn. */
  double exposure = 0;
  /** EGL platform: auto, device, surfaceless or default. */
  std::string egl_platform = "auto";

  /** @throws ConfigError  naming the value that is out of range, or the camera that `model` lacks.
   */
  void validate(const RobotModel& model) const;

  /** Name of the camera: `camera`, or the first one of the model. */
  std::string camera_name(const RobotModel& model) const;
};

}  // namespace nao::camera
