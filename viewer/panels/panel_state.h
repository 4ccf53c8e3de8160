#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rendering/pixel_box.h"
#include "viewer/view_choice.h"

namespace nao::viewer {

/** Settings that the user makes in the panels, and what the panels need for drawing. */
struct PanelState {
  ViewChoice choice;
  /** The view follows the robot. */
  bool follow = true;
  /** Name of the head camera whose images are shown, and whether its panel is open. */
  std::string camera;
  bool is_camera_open = true;
  /** Commanded velocity of the walk button, m/s, m/s, rad/s, and whether it is held. */
  float vx = 0.1f;
  float vy = 0;
  float wz = 0;
  bool is_walking = false;
  /** Speed of posture commands, fraction of the maximum. */
  float posture_speed = 0.5f;
  /** Time in the log that the slider was dragged to, s. */
  std::optional<double> requested_log_time;
  /** Whether the button "align" was pressed. */
  bool is_alignment_requested = false;
  /** Part of the field name that the list of fields must contain. */
  char field_filter[64] = "";
  std::string plot_channel;
  /** Parts of the window that the panels of this frame cover. */
  std::vector<PixelBox> covered;
};

}  // namespace nao::viewer
