#pragma once

#include <string>
#include <vector>

namespace nao {

/** Every tunable of nao-viewer. */
struct ViewerOptions {
  /** Name of the robot shown, the prefix of its channels. */
  std::string robot = "NAO";
  /** Log to play instead of listening to the bus; empty for the bus. */
  std::string log_file;
  /** Where to start in the log, s, and whether to stand still there. */
  double log_start = 0;
  bool is_paused = false;
  /** Picture to write after num_frames frames, then end; empty for none. */
  std::string screenshot;
  int num_frames = 30;
  /** Draw without a window or screen; needs a screenshot. */
  bool is_offscreen = false;
  /** Leave the panels out. */
  bool without_panels = false;
  /** How many times finer each side of a screenshot without panels is drawn, then averaged. */
  int supersample = 1;
  /** pixels. */
  int width = 1280;
  int height = 800;
  /** Texels; a window has time for a finer shadow map than the camera. */
  int shadow_size = 1024;
  /** Camera: azimuth and elevation (degrees), distance (m), and what it looks at, x, y, z (m). */
  std::vector<double> view;
  /** Curves at the start: CHANNEL:FIELD. */
  std::vector<std::string> plots;
  /** Posture shown while nothing is received. */
  std::string waiting_posture = "StandInit";
  /** Keep the robot in the middle. */
  bool follow = true;
  /** Leave out forces, centre of mass and all other marks. */
  bool without_marks = false;
  /** Draw the estimated robot translucent. */
  bool see_through = false;

  /** @throws ConfigError  naming what is out of range or does not fit together. */
  void validate() const;
};

}  // namespace nao
