#pragma once

#include <string>

namespace nao {

/** Every tunable of nao-head-camera. */
struct HeadCameraOptions {
  /** Own robot, as WORLD_TRUTH names it: whose camera this is. */
  std::string robot = "NAO";
  /** Render whether or not somebody watches, the camera, width and rate below. */
  bool always = false;
  std::string camera = "top";
  /** Pixels: 640, 320 or 160. */
  int width = 640;
  /** Pictures a second, 1 to 30. */
  double rate = 30;
  /** JPEG quality where nobody wishes for one, 1 to 95. */
  int quality = 80;
  /** Side of the shadow map, texels; 0 for no shadows. */
  int shadow_size = 320;
  /** What a real camera adds to the picture; 0 for none of it. Radial distortion of the lens
   * (lens.h). */
  double k1 = 0;
  double k2 = 0;
  /** Standard deviation of each colour, of 255 levels. */
  double noise = 0;
  /** How long the shutter is open before the state's time, s: what moves is blurred. */
  double exposure = 0;
  /** Way to the graphics driver: auto, device, surfaceless or default. */
  std::string egl_platform = "auto";

  /** @throws ConfigError  naming the value that is out of range. */
  void validate() const;
};

}  // namespace nao
