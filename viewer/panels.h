#pragma once

#include <string>
#include <vector>

#include "rendering/scene_renderer.h"
#include "robot_model/robot_model.h"
#include "viewer/command_sender.h"
#include "viewer/log_player.h"
#include "viewer/message_store.h"
#include "viewer/picture_texture.h"
#include "viewer/time_plots.h"
#include "viewer/world_view.h"

namespace nao {

/** Height of the plots at the window's lower edge, pixels. */
inline constexpr float kPlotsHeight = 230;

/** What a person set in the panels, and what the panels need to draw. */
struct PanelState {
  ViewChoice choice;
  bool follow = true;
  /** Head camera to watch, and whether its panel is open. */
  std::string camera = "top";
  bool watches_camera = true;
  /** Walk asked for while the button is held. */
  float vx = 0.1f;
  float vy = 0;
  float wz = 0;
  bool is_walking = false;
  float posture_speed = 0.5f;
  /** Place in the log that the person dragged the slider to; below 0 if not. */
  double wished_log_time = -1;
  bool wants_alignment = false;
  /** Text that narrows the list of fields. */
  char field_filter[64] = "";
  std::string plot_channel;
  /** Parts of the window that the panels of this frame hide. */
  std::vector<PixelBox> covered;
};

/** Panels around the 3D view. Each draws one ImGui window.
 * `commands` and `player` may be nullptr: without a bus nothing can be asked for, without a log
 * there is nothing to scrub. @param now  s, of the messages' time line. */
void draw_world_panel(const MessageStore& store, CommandSender* commands, PanelState& state,
                      double now);
void draw_motion_panel(const MessageStore& store, const RobotModel& model, CommandSender* commands,
                       PanelState& state, double now);
void draw_view_panel(PanelState& state, const std::vector<std::string>& problems);
void draw_camera_panel(const MessageStore& store, const PictureTexture& picture, PanelState& state);
void draw_programs_panel(const MessageStore& store, PanelState& state, double now);
void draw_plots_panel(const MessageStore& store, TimePlots& plots, PanelState& state, double now);
void draw_log_panel(LogPlayer& player, PanelState& state);

}  // namespace nao
