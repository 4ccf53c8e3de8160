#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/bus.h"
#include "rendering/scene_renderer.h"
#include "robot_model/robot_model.h"
#include "viewer/command_sender.h"
#include "viewer/log_player.h"
#include "viewer/message_store.h"
#include "viewer/orbit_camera.h"
#include "viewer/panels.h"
#include "viewer/picture_texture.h"
#include "viewer/time_plots.h"
#include "viewer/viewer_options.h"
#include "viewer/world_view.h"

namespace nao {

/** The viewer in whichever context is current: takes messages, draws frames. An ImGui context
 * exists as long as it does. */
class Viewer {
 public:
  /** @param model  Must outlive this. @param bus  nullptr if a log is played; must outlive this. */
  Viewer(const RobotModel& model, Bus* bus, const ViewerOptions& options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /** Draws one frame. ImGui's input (size, mouse, time) must have been set.
   * @param framebuffer  OpenGL's number of where to draw. @param now  s of the monotonic clock. */
  void draw(unsigned framebuffer, int width, int height, double now);

  int64_t num_frames() const { return num_frames_; }

 private:
  void receive(const std::string& channel, const uint8_t* data, int num_bytes, double time);
  /** Takes in what a log holds. */
  LogFile::Visitor receiver();
  void play(double now);
  void seek(double time);
  void update_picture();
  void send(double now);
  void steer(int width, int height, double now);
  void drag_ball(const Eigen::Vector3d& ray, double now);
  void drag_push(const Eigen::Vector3d& ray);
  void draw_panels(double now);
  /** Looks at the part of the window that the panels leave free. */
  PinholeCamera pinhole(int width, int height) const;
  const WorldView::Handle* handle_at(const Eigen::Vector3d& ray_in_camera, bool is_ball) const;
  /** Time line of the messages: the log's, or the monotonic clock. */
  double message_time(double now) const { return player_ ? player_->time() : now; }

  enum class Drag { kNone, kView, kBall, kPush };

  const RobotModel& model_;
  ViewerOptions options_;
  SceneRenderer renderer_;
  WorldView world_;
  MessageStore store_;
  TimePlots plots_;
  std::optional<CommandSender> commands_;
  Bus* bus_;
  std::optional<LogPlayer> player_;
  PictureTexture picture_;
  PanelState panels_;
  OrbitCamera camera_;
  Drag drag_ = Drag::kNone;
  WorldView::Handle held_;
  Eigen::Vector3d drag_point_ = Eigen::Vector3d::Zero();
  double last_draw_ = 0;
  double last_picture_ = -1;
  double last_camera_command_ = 0;
  double last_walk_ = 0;
  double last_ball_ = 0;
  int64_t num_frames_ = 0;
};

}  // namespace nao
