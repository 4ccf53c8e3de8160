#include "viewer/viewer.h"

#include <imgui.h>

#include <naolcm/camera_command_t.hpp>

#include "backends/imgui_impl_opengl3.h"
#include "common/bus.h"
#include "common/constants.h"
#include "common/wall_clock.h"
#include "viewer/panels/panels.h"

namespace nao::viewer {
namespace {

/** Interval of image requests, s: each is valid for 2 s. */
constexpr double kImageRequestPeriod = 1;
/** Requested images: the width of the panel in pixels, and a rate that shows motion and leaves time
 * for the simulator. */
constexpr int kImageWidth = 320;
constexpr double kImageRate = 15;

OrbitCamera initial_camera(const ViewerOptions& options) {
  OrbitCamera camera;
  if (options.view.size() >= 3) {
    camera.azimuth = options.view[0] * kDegree;
    camera.elevation = options.view[1] * kDegree;
    camera.distance = options.view[2];
  }
  if (options.view.size() == 6) {
    camera.target = Eigen::Map<const Eigen::Vector3d>(&options.view[3]);
  }
  return camera;
}

}  // namespace

Viewer::Viewer(const RobotModel& model, Bus* bus, const ViewerOptions& options)
    : model_(model),
      options_(options),
      renderer_(RendererOptions{.shadow_size = options.shadow_size}),
      world_(model, renderer_, options.robot, options.waiting_posture),
      store_(options.robot),
      bus_(bus),
      mouse_(initial_camera(options)) {
  panels_.follow = options.follow;
  if (options.without_marks) panels_.choice = ViewChoice::without_markings();
  panels_.choice.translucent = options.see_through;
  if (!model.cameras().empty()) panels_.camera = model.cameras().front().name;
  for (const std::string& plot : options.plots) {
    const size_t colon = plot.find(':');
    plots_.add(plot.substr(0, colon), plot.substr(colon + 1));
    panels_.plot_channel = plot.substr(0, colon);
  }
  if (bus_ != nullptr) {
    commands_.emplace(*bus_, store_.channels());
    bus_->subscribe_raw(".*", [this](const RawMessage& message) {
      receive(message.channel, message.bytes.data(), static_cast<int>(message.bytes.size()),
              monotonic_seconds());
    });
  } else {
    player_.emplace(LogFile(options.log_file));
    player_->is_paused = options.is_paused;
    seek(options.log_start);
  }
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Viewer::~Viewer() {
  ImGui_ImplOpenGL3_Shutdown();
}

void Viewer::receive(const std::string& channel, const uint8_t* data, int num_bytes, double time) {
  if (!store_.receive(channel, data, num_bytes, time)) {
    throw MessageError(
        "the message is not of its channel's type, or from another version of the project");
  }
  plots_.receive(channel, data, num_bytes, time);
  if (!commands_) return;
  if (channel == store_.channels().command_result) {
    commands_->receive(store_.results().back().message);
  } else if (channel == kWorldTruthChannel) {
    commands_->receive(store_.truth()->message);
  }
}

// A log has no state at a point in time: messages of the plots' window before it are read again.
void Viewer::seek(double time) {
  store_.clear();
  plots_.clear();
  image_time_ = -1;
  player_->seek(time, plots_.window(), log_visitor());
}

LogFile::Visitor Viewer::log_visitor() {
  // A log may contain channels of other projects, so messages that do not decode are not an error.
  return [this](const std::string& channel, const std::vector<uint8_t>& data, double time) {
    store_.receive(channel, data.data(), static_cast<int>(data.size()), time);
    plots_.receive(channel, data.data(), static_cast<int>(data.size()), time);
  };
}

void Viewer::advance_log(double now) {
  if (!player_) return;
  if (panels_.requested_log_time) seek(*panels_.requested_log_time);
  panels_.requested_log_time.reset();
  player_->advance(now - last_draw_, log_visitor());
}

void Viewer::update_image() {
  if (!store_.image() || store_.image()->time == image_time_) return;
  image_time_ = store_.image()->time;
  image_.load_jpeg(store_.image()->message.data);
}

// A walk's velocities are sent while its button is held.
void Viewer::send_commands(double now) {
  if (!commands_) return;
  if (panels_.is_walking) {
    commands_->walk(panels_.vx, panels_.vy, panels_.wz);
  } else {
    commands_->end_walk();
  }
  commands_->repeat(now);
  if (panels_.is_camera_open && now - last_image_request_ >= kImageRequestPeriod) {
    naolcm::camera_command_t command{};
    command.camera = panels_.camera;
    command.width = kImageWidth;
    command.rate = kImageRate;
    commands_->request_images(command);
    last_image_request_ = now;
  }
}

PinholeCamera Viewer::pinhole(int width, int height) const {
  PinholeCamera pinhole = mouse_.camera().pinhole(width, height);
  if (!options_.without_panels) pinhole.cy -= 0.5 * kPlotsHeight;
  return pinhole;
}

void Viewer::draw_panels(double now) {
  const double time = message_time(now);
  ViewerCommands* commands = commands_ ? &*commands_ : nullptr;
  draw_world_panel(store_, commands, panels_, time);
  draw_motion_panel(store_, model_, commands, panels_, time);
  draw_view_panel(panels_, world_.problems());
  draw_camera_panel(store_, model_, image_, panels_);
  draw_programs_panel(store_, panels_, time);
  draw_plots_panel(store_, plots_, panels_, time);
  if (player_) draw_log_panel(*player_, panels_);
}

void Viewer::draw(unsigned framebuffer, int width, int height, double now) {
  // The state of the world, from the log or the bus.
  if (num_frames_ == 0) last_draw_ = now;
  advance_log(now);
  last_draw_ = now;
  update_image();
  if (panels_.is_alignment_requested) world_.align();
  panels_.is_alignment_requested = false;
  world_.update(store_, panels_.choice);
  if (panels_.follow && world_.has_robot()) {
    mouse_.camera().target.head<2>() = world_.pose_torso_in_world().translation().head<2>();
  }

  // Mouse and panels, which change the camera, send commands and cover parts of the view.
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  ViewerCommands* commands = commands_ ? &*commands_ : nullptr;
  if (mouse_.update(world_, pinhole(width, height), commands, now)) panels_.follow = false;
  panels_.covered.clear();
  if (!options_.without_panels) draw_panels(now);
  ImGui::Render();
  send_commands(now);

  renderer_.render(world_.scene(), pinhole(width, height), mouse_.camera().pose(), framebuffer,
                   panels_.covered);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  ++num_frames_;
}

}  // namespace nao::viewer
