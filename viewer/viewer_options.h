#pragma once

#include <string>
#include <vector>

namespace nao::viewer {

/** Options of nao-viewer. */
struct ViewerOptions {
  /** Name of the robot shown, the prefix of its channels. */
  std::string robot = "NAO";
  /** Its folder in robots/; other robots of the world have the models that the simulator tells. */
  std::string model = "nao";
  /** Log to play; empty: listen to the bus. */
  std::string log_file;
  /** Start in the log, s, and whether it is paused there. */
  double log_start = 0;
  bool is_paused = false;
  /** PNG file to write after num_frames frames, after which the program ends; empty: none. */
  std::string screenshot;
  int num_frames = 30;
  /** Draw without a window or screen; needs a screenshot. */
  bool is_offscreen = false;
  /** Draw the 3D view only. */
  bool without_panels = false;
  /** Resolution factor of each side of a screenshot without panels before it is downsampled. */
  int supersample = 1;
  /** Size of the window, pixels. */
  int width = 1280;
  int height = 800;
  /** Side of the shadow map, texels; finer than the head camera's, since the viewer draws larger
   * images. */
  int shadow_size = 1024;
  /** Camera: azimuth and elevation (degrees), distance (m), optionally the target x, y, z (m). */
  std::vector<double> view;
  /** Curves at the start: CHANNEL:FIELD. */
  std::vector<std::string> plots;
  /** Posture shown before a state is received. */
  std::string waiting_posture{};
  /** Whether the view follows the robot. */
  bool follow = true;
  /** Draw no markings: forces, center of mass, footsteps and so on. */
  bool without_marks = false;
  /** Draw the estimated robot translucent. */
  bool see_through = false;

  /** @throws ConfigError  if a value is out of range or options do not fit together. */
  void validate() const;
};

}  // namespace nao::viewer
