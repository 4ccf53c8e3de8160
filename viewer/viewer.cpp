#include "viewer/viewer.h"

#include <imgui.h>
#include <unistd.h>

#include <cmath>
#include <naolcm/camera_command_t.hpp>

#include "backends/imgui_impl_opengl3.h"
#include "common/wall_clock.h"
#include "rendering/gl_objects.h"

namespace nao {
namespace {

/** Impulse for each metre that a push is dragged, N s/m, and the greatest. */
constexpr double kPushPerMetre = 5;
constexpr double kGreatestPush = 10;
const Color kPushColor(0.95f, 0.75f, 0.05f, 1);
constexpr double kDegree = M_PI / 180;

}  // namespace

Viewer::Viewer(const RobotModel& model, Bus* bus, const ViewerOptions& options)
    : model_(model),
      options_(options),
      renderer_(RendererOptions{.shadow_size = options.shadow_size}),
      world_(model, renderer_, options.robot, options.waiting_posture),
      store_(options.robot),
      bus_(bus) {
  panels_.follow = options.follow;
  if (options.without_marks) {
    panels_.choice = {true, false, false, false, false, false, false, false};
  }
  panels_.choice.see_through = options.see_through;
  if (options.view.size() >= 3) {
    camera_.azimuth = options.view[0] * kDegree;
    camera_.elevation = options.view[1] * kDegree;
    camera_.distance = options.view[2];
  }
  if (options.view.size() == 6) {
    camera_.target = Eigen::Map<const Eigen::Vector3d>(&options.view[3]);
  }
  for (const std::string& plot : options.plots) {
    const size_t colon = plot.find(':');
    plots_.add(plot.substr(0, colon), plot.substr(colon + 1));
    panels_.plot_channel = plot.substr(0, colon);
  }
  if (bus_ != nullptr) {
    commands_.emplace(*bus_, store_.channels());
    bus_->subscribe_raw(".*", [this](const std::string& channel, const uint8_t* data, int size) {
      receive(channel, data, size, monotonic_seconds());
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
    throw std::runtime_error("not of its channel's type, or from another version of the project");
  }
  plots_.receive(channel, data, num_bytes, time);
  if (!commands_) return;
  if (channel == store_.channels().command_result) {
    commands_->receive(store_.results().back().message);
  } else if (channel == kWorldTruthChannel) {
    commands_->receive(store_.truth()->message);
  }
}

void Viewer::seek(double time) {
  store_.clear();
  plots_.clear();
  last_picture_ = -1;
  player_->seek(time, plots_.window(), receiver());
}

LogFile::Visitor Viewer::receiver() {
  // What does not decode was not the project's: a log may hold other channels.
  return [this](const std::string& channel, const std::vector<uint8_t>& data, double time) {
    store_.receive(channel, data.data(), static_cast<int>(data.size()), time);
    plots_.receive(channel, data.data(), static_cast<int>(data.size()), time);
  };
}

void Viewer::play(double now) {
  if (!player_) return;
  if (panels_.wished_log_time >= 0) {
    seek(panels_.wished_log_time);
    panels_.wished_log_time = -1;
  }
  player_->advance(now - last_draw_, receiver());
}

void Viewer::update_picture() {
  if (!store_.image() || store_.image()->time == last_picture_) return;
  const naolcm::image_t& image = store_.image()->message;
  last_picture_ = store_.image()->time;
  picture_.load_jpeg(image.data);
}

void Viewer::send(double now) {
  if (!commands_) return;
  commands_->repeat(now);
  constexpr double kWalkPeriod = 0.1;
  if (!panels_.is_walking) {
    commands_->end_walk();
  } else if (now - last_walk_ >= kWalkPeriod) {
    commands_->walk(panels_.vx, panels_.vy, panels_.wz);
    last_walk_ = now;
  }
  constexpr double kCameraPeriod = 1;
  if (panels_.watches_camera && now - last_camera_command_ >= kCameraPeriod) {
    naolcm::camera_command_t command{};
    command.utime = 0;
    command.wall_utime = wall_utime();
    command.source = "viewer." + std::to_string(getpid());
    command.camera = panels_.camera;
    command.width = 320;
    command.rate = 15;
    bus_->publish(store_.channels().head_camera_command, command);
    last_camera_command_ = now;
  }
}

const WorldView::Handle* Viewer::handle_at(const Eigen::Vector3d& ray_in_camera,
                                           bool is_ball) const {
  const Eigen::Isometry3d pose = camera_.pose();
  const Eigen::Vector3d ray = (pose.linear() * ray_in_camera).normalized();
  const WorldView::Handle* nearest = nullptr;
  double nearest_depth = 0;
  for (const WorldView::Handle& handle : world_.handles()) {
    if ((handle.link == "ball") != is_ball) continue;
    const Eigen::Vector3d way = handle.center - pose.translation();
    const double depth = way.dot(ray);
    if (depth <= 0 || (way - depth * ray).norm() > 1.3 * handle.radius) continue;
    if (nearest == nullptr || depth < nearest_depth) {
      nearest = &handle;
      nearest_depth = depth;
    }
  }
  return nearest;
}

void Viewer::drag_ball(const Eigen::Vector3d& ray, double now) {
  Eigen::Vector3d point;
  if (!meets_plane(camera_.pose(), ray, held_.radius, point) || point.norm() > 20) return;
  constexpr double kPeriod = 0.1;
  if (now - last_ball_ < kPeriod || (point - drag_point_).norm() < 1e-3) return;
  drag_point_ = point;
  last_ball_ = now;
  commands_->place_ball(point.x(), point.y());
}

void Viewer::drag_push(const Eigen::Vector3d& ray) {
  Eigen::Vector3d point;
  if (!meets_plane(camera_.pose(), ray, held_.center.z(), point)) return;
  Eigen::Vector3d way = point - held_.center;
  if (kPushPerMetre * way.norm() > kGreatestPush) way *= kGreatestPush / kPushPerMetre / way.norm();
  drag_point_ = held_.center + way;
}

PinholeCamera Viewer::pinhole(int width, int height) const {
  PinholeCamera pinhole = camera_.pinhole(width, height);
  if (!options_.without_panels) pinhole.cy -= 0.5 * kPlotsHeight;
  return pinhole;
}

void Viewer::steer(int width, int height, double now) {
  const ImGuiIO& io = ImGui::GetIO();
  const Eigen::Vector3d ray =
      pinhole(width, height).ray({io.MousePos.x - 0.5, io.MousePos.y - 0.5});
  if (!io.WantCaptureMouse) {
    camera_.zoom(io.MouseWheel);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      const WorldView::Handle* handle = commands_ ? handle_at(ray, !io.KeyCtrl) : nullptr;
      drag_ = handle == nullptr ? Drag::kView : io.KeyCtrl ? Drag::kPush : Drag::kBall;
      if (handle != nullptr) {
        held_ = *handle;
        drag_point_ = held_.center;
      }
    }
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
      camera_.pan(io.MouseDelta.x, io.MouseDelta.y, height);
      if (io.MouseDelta.x != 0 || io.MouseDelta.y != 0) panels_.follow = false;
    }
  }
  if (drag_ == Drag::kView) camera_.rotate(io.MouseDelta.x, io.MouseDelta.y);
  if (drag_ == Drag::kBall) drag_ball(ray, now);
  if (drag_ == Drag::kPush) drag_push(ray);
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
  if (drag_ == Drag::kPush) {
    commands_->push(held_.robot, held_.link, kPushPerMetre * (drag_point_ - held_.center));
  }
  drag_ = Drag::kNone;
}

void Viewer::draw_panels(double now) {
  const double time = message_time(now);
  CommandSender* commands = commands_ ? &*commands_ : nullptr;
  draw_world_panel(store_, commands, panels_, time);
  draw_motion_panel(store_, model_, commands, panels_, time);
  draw_view_panel(panels_, world_.problems());
  draw_camera_panel(store_, picture_, panels_);
  draw_programs_panel(store_, panels_, time);
  draw_plots_panel(store_, plots_, panels_, time);
  if (player_) draw_log_panel(*player_, panels_);
}

void Viewer::draw(unsigned framebuffer, int width, int height, double now) {
  if (num_frames_ == 0) last_draw_ = now;
  play(now);
  last_draw_ = now;
  update_picture();
  if (panels_.wants_alignment) world_.align();
  panels_.wants_alignment = false;
  world_.update(store_, panels_.choice);
  if (panels_.follow && world_.has_robot()) {
    camera_.target.head<2>() = world_.pose_torso_in_world().translation().head<2>();
  }

  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  steer(width, height, now);
  if (drag_ == Drag::kPush) world_.add_arrow(held_.center, drag_point_, kPushColor);
  panels_.covered.clear();
  if (!options_.without_panels) draw_panels(now);
  ImGui::Render();
  send(now);

  renderer_.render(world_.scene(), pinhole(width, height), camera_.pose(), framebuffer,
                   panels_.covered);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  ++num_frames_;
}

}  // namespace nao
