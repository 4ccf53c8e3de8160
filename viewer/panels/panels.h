#pragma once

#include <string>
#include <vector>

namespace nao {
class RobotModel;
}

namespace nao::viewer {

class ViewerCommands;
class ImageTexture;
class LogPlayer;
class MessageStore;
class TimePlots;
struct PanelState;

/** Height of the plots at the lower edge of the window, pixels. */
inline constexpr float kPlotsHeight = 230;

/** Panels around the 3D view; each draws one ImGui window.
 *
 * @param commands  nullptr while a log is played: no commands can be sent.
 * @param now  s, on the time line of the messages: monotonic, or of the log. */
void draw_world_panel(const MessageStore& store, ViewerCommands* commands, PanelState& state,
                      double now);
void draw_motion_panel(const MessageStore& store, const RobotModel& model, ViewerCommands* commands,
                       PanelState& state, double now);
/** @param problems  Faults of messages and files, one sentence each. */
void draw_view_panel(PanelState& state, const std::vector<std::string>& problems);
void draw_camera_panel(const MessageStore& store, const RobotModel& model,
                       const ImageTexture& image, PanelState& state);
void draw_programs_panel(const MessageStore& store, PanelState& state, double now);
void draw_plots_panel(const MessageStore& store, TimePlots& plots, PanelState& state, double now);
void draw_log_panel(LogPlayer& player, PanelState& state);

}  // namespace nao::viewer
