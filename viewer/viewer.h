#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "rendering/scene_renderer.h"
#include "viewer/image_texture.h"
#include "viewer/log_player.h"
#include "viewer/message_store.h"
#include "viewer/mouse_control.h"
#include "viewer/panels/panel_state.h"
#include "viewer/time_plots.h"
#include "viewer/viewer_commands.h"
#include "viewer/viewer_options.h"
#include "viewer/world_view.h"

namespace nao::viewer {

/** The viewer in the current OpenGL context: receives messages and draws frames. An ImGui context
 * must exist during its lifetime. */
class Viewer {
 public:
  /** @param model  Must outlive this. @param bus  Must outlive this; nullptr: a log is played. */
  Viewer(const RobotModel& model, Bus* bus, const ViewerOptions& options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /** Draws one frame. ImGui's input (size, mouse, time) must be set.
   * @param framebuffer  OpenGL's number of the target. @param now  s, monotonic. */
  void draw(unsigned framebuffer, int width, int height, double now);

  int64_t num_frames() const { return num_frames_; }

 private:
  void receive(const std::string& channel, const uint8_t* data, int num_bytes, double time);
  /** Stores and plots the messages of a log. */
  LogFile::Visitor log_visitor();
  void advance_log(double now);
  void seek(double time);
  void update_image();
  /** Sends the commands that are repeated: walk, image request, and those without a result. */
  void send_commands(double now);
  void draw_panels(double now);
  /** Intrinsics of the view, whose center is in the part of the window above the plots. */
  PinholeCamera pinhole(int width, int height) const;
  /** Time line of the messages: that of the log, or the monotonic clock. */
  double message_time(double now) const { return player_ ? player_->time() : now; }

  const RobotModel& model_;
  ViewerOptions options_;
  SceneRenderer renderer_;
  WorldView world_;
  MessageStore store_;
  TimePlots plots_;
  /** nullptr if a log is played; commands_ is then empty and player_ is not. */
  Bus* bus_;
  std::optional<ViewerCommands> commands_;
  std::optional<LogPlayer> player_;
  ImageTexture image_;
  PanelState panels_;
  MouseControl mouse_;
  // Times of the last frame, walk message and image request, s, and of the image that is shown.
  double last_draw_ = 0;
  double last_image_request_ = 0;
  double image_time_ = -1;
  int64_t num_frames_ = 0;
};

}  // namespace nao::viewer
