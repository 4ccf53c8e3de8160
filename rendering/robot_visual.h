#pragma once

#include <string>
#include <vector>

#include "rendering/scene.h"
#include "robot_model/robot_model.h"

namespace nao {

class SceneRenderer;

/** Appearance of a robot: the meshes of its links, stored by a renderer.
 *
 * A link whose mesh cannot be read is drawn by its collision shapes; problems() reports it. */
class RobotVisual {
 public:
  /** @param model, renderer  Must outlive this. */
  RobotVisual(const RobotModel& model, SceneRenderer& renderer);

  /** Files that could not be read, one sentence each. */
  const std::vector<std::string>& problems() const { return problems_; }

  const RobotModel& model() const { return model_; }

  /** Adds the robot to a scene.
   * @param link_poses_in_world  Of all links, in the order of model().links().
   * @param tint  Factor on its colors; an opacity below 1 makes it translucent.
   * @param hidden_link  Index of a link that is not drawn, -1 for none: the head that contains the
   *   camera is not visible to it. */
  void append(Scene& scene, const std::vector<Eigen::Isometry3d>& link_poses_in_world,
              const Color& tint = Color::Ones(), int hidden_link = -1) const;

 private:
  struct Part {
    int link;
    MeshId mesh;
    Eigen::Isometry3f pose_in_link;
  };

  void add_shape(SceneRenderer& renderer, int link, const Shape& shape);

  const RobotModel& model_;
  std::vector<Part> parts_;
  std::vector<std::string> problems_;
};

/** Poses of all links in the world. @param position  rad, (num_motors), motor order. */
std::vector<Eigen::Isometry3d> link_poses_in_world(const RobotModel& model,
                                                   const Eigen::Isometry3d& pose_torso_in_world,
                                                   const std::vector<double>& position);

/** The body that a massless frame, such as a camera's, is fixed to: its nearest ancestor over fixed
 * joints that has visuals; `link` itself if none has. */
int carrying_link(const RobotModel& model, int link);

}  // namespace nao
