#pragma once

#include <string>
#include <vector>

#include "rendering/scene.h"
#include "rendering/scene_renderer.h"
#include "robot_model/robot_model.h"

namespace nao {

/** What a robot looks like: its meshes, kept by a renderer, and how they hang together.
 *
 * A mesh that cannot be read is replaced by the link's collision shapes, so that the rest goes on;
 * problems() says which. */
class RobotVisual {
 public:
  /** @param model, renderer  Must outlive this. */
  RobotVisual(const RobotModel& model, SceneRenderer& renderer);

  /** What could not be read, one sentence each. */
  const std::vector<std::string>& problems() const { return problems_; }

  const RobotModel& model() const { return model_; }

  /** Adds the robot to a scene.
   * @param link_poses_in_world  Of every link, as model().link_poses() orders them.
   * @param tint  Multiplies its colours; below 1, the last one makes it translucent.
   * @param hidden_link  Index of a link to leave out, -1 for none: a camera does not see the head
   *   that it sits in. */
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

/** The link with a body that carries a massless frame, such as a camera's: the frame's nearest
 * ancestor over fixed joints that has visuals; `link` itself if none has. */
int carrying_link(const RobotModel& model, int link);

}  // namespace nao
