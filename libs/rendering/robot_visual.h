#pragma once

#include <array>
#include <string>
#include <vector>

#include "rendering/robot_shirt.h"
#include "rendering/scene.h"
#include "rendering/world_state.h"
#include "robot_model/robot_model.h"

namespace nao {

class SceneRenderer;

/** Appearance of a robot: the meshes of its links, stored by a renderer.
 *
 * A link whose mesh cannot be read is drawn by its collision shapes, which problems() reports, as
 * is a robot without any visual. */
class RobotVisual {
 public:
  /** @param model, renderer  Must outlive this. */
  RobotVisual(const RobotModel& model, SceneRenderer& renderer);

  /** Files that could not be read, one sentence each. */
  const std::vector<std::string>& problems() const { return problems_; }

  const RobotModel& model() const { return model_; }

  /** Adds the lights that are on to a scene; no other light affects them.
   * @param hidden_link  As in append(). A light that the robot does not have is not drawn. */
  void append_lights(Scene& scene, const std::vector<Eigen::Isometry3d>& link_poses_in_world,
                     const std::vector<LitLight>& lights, int hidden_link = -1) const;

  /** Adds the shirt of a team with a number to a scene, on the first link that has visuals: the
   * torso. @param hidden_link  As in append(). */
  void append_shirt(Scene& scene, const std::vector<Eigen::Isometry3d>& link_poses_in_world,
                    int team, int number, int hidden_link = -1) const;

  /** Adds the robot to a scene.
   * @param link_poses_in_world  Poses of all links, in the order of model().links().
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

  /** The surface of a light. */
  struct LightSurface {
    std::string name;
    int link;
    /** m, in the link's frame. */
    std::vector<std::array<Eigen::Vector3f, 3>> triangles;
  };

  void make_torso_shirt(SceneRenderer& renderer);

  const RobotModel& model_;
  std::vector<Part> parts_;
  RobotShirt shirt_;
  /** Mesh of the shirt's band; -1 if there is none. */
  MeshId shirt_mesh_ = -1;
  int torso_ = -1;
  std::vector<LightSurface> lights_;
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
