#include "viewer/mouse_control.h"

#include <imgui.h>

#include "viewer/viewer_commands.h"
#include "viewer/world_view.h"

namespace nao::viewer {
namespace {

/** Impulse for each meter that a push is dragged, N s/m, and its limit, N s. Chosen: 6 N s to
 * the side make a standing robot fall, so that small pushes and falls are both within reach. */
constexpr double kImpulsePerMeter = 5;
constexpr double kMaxImpulse = 10;
const Color kPushColor(0.95f, 0.75f, 0.05f, 1);
/** Factor on the radius of a handle in which it is grabbed. */
constexpr double kGrabFactor = 1.3;
/** Least time between two placements of the ball, s, and least distance by which it was dragged
 * before, m. */
constexpr double kBallPeriod = 0.1;
constexpr double kMinBallMotion = 1e-3;
/** Limit of the ball's distance from the origin, m: outside of the hall. A ray near the horizon
 * would put it anywhere. */
constexpr double kMaxBallDistance = 20;

}  // namespace

// Left button: rotate the view, drag the ball, or push (with Ctrl) a link; right or middle: pan;
// wheel: zoom. Returns whether the view was panned.
bool MouseControl::update(WorldView& world, const PinholeCamera& pinhole, ViewerCommands* commands,
                          double now) {
  const ImGuiIO& io = ImGui::GetIO();
  // ImGui's (0, 0) is the corner of the first pixel, the camera's is its center.
  const Eigen::Vector3d ray = pinhole.ray({io.MousePos.x - 0.5, io.MousePos.y - 0.5});
  bool is_panned = false;
  if (!io.WantCaptureMouse) {
    camera_.zoom(io.MouseWheel);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) start_drag(world, ray, commands != nullptr);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
      camera_.pan(io.MouseDelta.x, io.MouseDelta.y, pinhole.height);
      is_panned = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
    }
  }
  if (drag_ == Drag::kView) camera_.rotate(io.MouseDelta.x, io.MouseDelta.y);
  if (drag_ == Drag::kBall) drag_ball(ray, *commands, now);
  if (drag_ == Drag::kPush) drag_push(ray);
  // The push happens when the button is released; until then its arrow is shown.
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (drag_ == Drag::kPush) {
      commands->push(grabbed_.robot, grabbed_.link,
                     kImpulsePerMeter * (drag_point_ - grabbed_.center));
    }
    drag_ = Drag::kNone;
  }
  if (drag_ == Drag::kPush) world.add_arrow(grabbed_.center, drag_point_, kPushColor);
  return is_panned;
}

void MouseControl::start_drag(const WorldView& world, const Eigen::Vector3d& ray_in_camera,
                              bool can_grab) {
  const bool is_push = ImGui::GetIO().KeyCtrl;
  const Handle* handle = can_grab ? handle_at(world, ray_in_camera, !is_push) : nullptr;
  drag_ = handle == nullptr ? Drag::kView : is_push ? Drag::kPush : Drag::kBall;
  if (handle == nullptr) return;
  grabbed_ = *handle;
  drag_point_ = grabbed_.center;
}

const Handle* MouseControl::handle_at(const WorldView& world, const Eigen::Vector3d& ray_in_camera,
                                      bool is_ball) const {
  const Eigen::Isometry3d pose = camera_.pose();
  const Eigen::Vector3d ray = (pose.linear() * ray_in_camera).normalized();
  const Handle* nearest = nullptr;
  double nearest_depth = 0;
  for (const Handle& handle : world.handles()) {
    if ((handle.link == kBallLink) != is_ball) continue;
    // Distance of the handle along the ray, and perpendicular to it.
    const Eigen::Vector3d to_handle = handle.center - pose.translation();
    const double depth = to_handle.dot(ray);
    const double miss = (to_handle - depth * ray).norm();
    if (depth <= 0 || miss > kGrabFactor * handle.radius) continue;
    // Take the nearest of several handles on the ray.
    if (nearest == nullptr || depth < nearest_depth) {
      nearest = &handle;
      nearest_depth = depth;
    }
  }
  return nearest;
}

void MouseControl::drag_ball(const Eigen::Vector3d& ray_in_camera, ViewerCommands& commands,
                             double now) {
  Eigen::Vector3d point;
  // The ball moves on the plane at the height of its center.
  if (!intersect_plane(camera_.pose(), ray_in_camera, grabbed_.radius, point) ||
      point.norm() > kMaxBallDistance) {
    return;
  }
  if (now - last_ball_command_ < kBallPeriod || (point - drag_point_).norm() < kMinBallMotion) {
    return;
  }
  drag_point_ = point;
  last_ball_command_ = now;
  commands.place_ball(point.x(), point.y());
}

void MouseControl::drag_push(const Eigen::Vector3d& ray_in_camera) {
  // The push is horizontal: the mouse moves in the plane at the height of the link.
  Eigen::Vector3d point;
  if (!intersect_plane(camera_.pose(), ray_in_camera, grabbed_.center.z(), point)) return;
  Eigen::Vector3d arrow = point - grabbed_.center;
  const double impulse = kImpulsePerMeter * arrow.norm();
  if (impulse > kMaxImpulse) arrow *= kMaxImpulse / impulse;
  drag_point_ = grabbed_.center + arrow;
}

}  // namespace nao::viewer
