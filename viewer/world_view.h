#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/odometry_alignment.h"
#include "rendering/robot_visuals.h"
#include "rendering/scene.h"
#include "rendering/scene_surroundings.h"
#include "rendering/world_state.h"
#include "robot_model/robot_model.h"
#include "robot_model/robot_models.h"
#include "viewer/handle.h"
#include "viewer/markers.h"
#include "viewer/view_choice.h"

namespace naolcm {
class motion_state_t;
class robot_state_t;
class world_truth_t;
}  // namespace naolcm

namespace nao::viewer {

class MessageStore;

/** Converts messages to a scene: the estimated and the true robots, the ball, and markings. */
class WorldView {
 public:
  /** @param model, renderer  Must outlive this. @param robot  Name of the robot that is estimated.
   * @param waiting_posture  Posture shown before its state is received. */
  WorldView(const RobotModel& model, SceneRenderer& renderer, const std::string& robot,
            const std::string& waiting_posture);

  /** Replaces the scene by one of the newest messages. */
  void update(const MessageStore& store, const ViewChoice& choice);

  const Scene& scene() const { return scene_; }
  /** Faults of messages and files in the last update, one sentence each. */
  const std::vector<std::string>& problems() const { return problems_; }
  /** Handles that the mouse can grab. */
  const std::vector<Handle>& handles() const { return handles_; }

  /** Pose of the robot's torso, for a camera that follows it; valid if has_robot(). */
  const Eigen::Isometry3d& pose_torso_in_world() const { return pose_torso_in_world_; }
  bool has_robot() const { return has_robot_; }

  /** Aligns the frame of the estimate with the true robot at the next update. */
  void align() { odometry_.reset(); }

  /** Adds an arrow until the next update; m, in the world. */
  void add_arrow(const Eigen::Vector3d& from, const Eigen::Vector3d& tip, const Color& color) {
    markers_.add_arrow(scene_, from, tip, color);
  }

 private:
  void add_truth(const naolcm::world_truth_t& truth, const ViewChoice& choice, bool has_estimate);
  void add_contact_forces(const naolcm::world_truth_t& truth);
  void add_handles(const RobotPose& robot, const std::vector<Eigen::Isometry3d>& poses);
  void add_estimate(const naolcm::robot_state_t& state, const ViewChoice& choice);
  void add_markings(const naolcm::robot_state_t& state, const ViewChoice& choice);
  void add_footsteps(const naolcm::motion_state_t& motion);
  void add_waiting_robot();

  const RobotModel& model_;
  RobotModels models_;
  RobotVisuals visuals_;
  std::string robot_;
  std::string waiting_posture_;
  Markers markers_;
  SceneSurroundings surroundings_;
  OdometryAlignment odometry_;
  // Results of the last update.
  Scene scene_;
  std::vector<std::string> problems_;
  std::vector<Handle> handles_;
  std::optional<WorldState> truth_;
  Eigen::Isometry3d pose_torso_in_world_ = Eigen::Isometry3d::Identity();
  bool has_robot_ = false;
};

}  // namespace nao::viewer
