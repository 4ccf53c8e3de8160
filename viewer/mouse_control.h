#pragma once

#include <Eigen/Core>

#include "rendering/pinhole_camera.h"
#include "viewer/handle.h"
#include "viewer/orbit_camera.h"

namespace nao::viewer {

class ViewerCommands;
class WorldView;

/** Mouse in the 3D view: moves the camera, drags the ball, pushes links of robots. */
class MouseControl {
 public:
  explicit MouseControl(const OrbitCamera& camera) : camera_(camera) {}

  OrbitCamera& camera() { return camera_; }
  const OrbitCamera& camera() const { return camera_; }

  /** Handles the mouse of one frame, as ImGui reports it.
   * @param world  Its handles can be grabbed; while a push is dragged, its arrow is added.
   * @param pinhole  Intrinsics of the view. @param commands  nullptr: nothing can be grabbed.
   * @param now  s, monotonic.
   * @return true if the camera was moved sideways, so that it should not follow the robot any more.
   */
  bool update(WorldView& world, const PinholeCamera& pinhole, ViewerCommands* commands, double now);

 private:
  enum class Drag { kNone, kView, kBall, kPush };

  /** Starts to drag the object under the mouse: a handle, or the view. */
  void start_drag(const WorldView& world, const Eigen::Vector3d& ray_in_camera, bool can_grab);
  /** @return nullptr if the ray hits no handle. */
  const Handle* handle_at(const WorldView& world, const Eigen::Vector3d& ray_in_camera,
                          bool is_ball) const;
  void drag_ball(const Eigen::Vector3d& ray_in_camera, ViewerCommands& commands, double now);
  void drag_push(const Eigen::Vector3d& ray_in_camera);

  OrbitCamera camera_;
  Drag drag_ = Drag::kNone;
  Handle grabbed_;
  /** Where the mouse has dragged the handle to, m, in the world. */
  Eigen::Vector3d drag_point_ = Eigen::Vector3d::Zero();
  double last_ball_command_ = 0;
};

}  // namespace nao::viewer
