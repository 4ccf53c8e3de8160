#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "rendering/robot_visual.h"
#include "rendering/scene.h"
#include "rendering/scene_renderer.h"
#include "rendering/world_state.h"
#include "robot_model/robot_model.h"
#include "viewer/message_store.h"

namespace nao {

/** What a person wants to see. */
struct ViewChoice {
  bool estimated_robot = true;
  bool true_robot = true;
  bool contact_forces = true;
  bool center_of_mass = true;
  bool center_of_pressure = true;
  bool support_polygon = true;
  bool footsteps = true;
  /** Draws the estimated robot translucent, so that the marks inside show. */
  bool see_through = false;
};

/** From messages to a scene: robots as estimated and as they truly are, ball, and markings. */
class WorldView {
 public:
  /** @param model, renderer  Must outlive this. @param robot  Name of the robot shown. */
  WorldView(const RobotModel& model, SceneRenderer& renderer, const std::string& robot,
            const std::string& waiting_posture);

  /** Makes the scene anew from what the store holds. */
  void update(const MessageStore& store, const ViewChoice& choice);

  const Scene& scene() const { return scene_; }
  /** What is wrong with messages or files, one sentence each; of the last update. */
  const std::vector<std::string>& problems() const { return problems_; }

  /** A place that a person can take hold of. */
  struct Handle {
    /** Robot's name and link; the ball has the link "ball". */
    std::string robot;
    std::string link;
    /** m, in the world. */
    Eigen::Vector3d center;
    double radius;
  };
  const std::vector<Handle>& handles() const { return handles_; }

  /** Where the robot shown stands, for a camera that follows it. */
  const Eigen::Isometry3d& pose_torso_in_world() const { return pose_torso_in_world_; }
  bool has_robot() const { return has_robot_; }

  /** Puts the estimate's frame where the true robot is now, as at the start. */
  void align() { is_aligned_ = false; }

  /** Adds an arrow, m. @param tip  Its end, in the world. */
  void add_arrow(const Eigen::Vector3d& from, const Eigen::Vector3d& tip, const Color& color);
  void add_sphere(const Eigen::Vector3d& center, double radius, const Color& color);

 private:
  void set_scene(const std::string& name);
  void add_truth(const naolcm::world_truth_t& truth, const ViewChoice& choice, bool is_alone);
  void add_estimate(const naolcm::robot_state_t& state, const ViewChoice& choice);
  void add_markings(const naolcm::robot_state_t& state, const ViewChoice& choice);
  void add_footsteps(const naolcm::motion_state_t& motion);
  void add_waiting_robot();
  void align_odometry(const naolcm::robot_state_t& state);
  void add_polygon(const std::vector<Eigen::Vector3d>& corners, const Color& color);
  void add_disc(const Eigen::Vector3d& center, double radius, const Color& color);
  void add_handles(const RobotPose& robot, const std::vector<Eigen::Isometry3d>& poses);

  const RobotModel& model_;
  SceneRenderer& renderer_;
  RobotVisual visual_;
  std::string robot_;
  std::string waiting_posture_;
  MeshId arrow_;
  MeshId sphere_;
  Scene scene_;
  std::optional<std::string> scene_name_;
  SceneFile scene_file_;
  std::string scene_problem_;
  std::vector<std::string> problems_;
  std::vector<Handle> handles_;
  Eigen::Isometry3d pose_torso_in_world_ = Eigen::Isometry3d::Identity();
  bool has_robot_ = false;
  std::optional<WorldState> truth_;
  /** From the odometry frame, in which motion estimates, to the world. */
  Eigen::Isometry3d pose_odometry_in_world_ = Eigen::Isometry3d::Identity();
  bool is_aligned_ = false;
  int64_t aligned_utime_ = 0;
};

}  // namespace nao
