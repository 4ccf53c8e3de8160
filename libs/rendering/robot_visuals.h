#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rendering/robot_visual.h"
#include "rendering/world_state.h"

namespace nao {

/** Appearances of the robots of a world, one for each model; made when they are first needed. */
class RobotVisuals {
 public:
  /** @param own  Model of robots that name none. It and the renderer must outlive this. */
  RobotVisuals(const RobotModel& own, SceneRenderer& renderer);

  /** The appearance of a robot. */
  const RobotVisual& of(const RobotPose& robot);
  const RobotVisual& own() const { return *own_; }

  /** Adds a robot with its lights and its shirt to a scene.
   * @param tint, hidden_link  See RobotVisual::append().
   * @return Poses of its links in the world. */
  std::vector<Eigen::Isometry3d> append(Scene& scene, const RobotPose& robot,
                                        const Color& tint = Color::Ones(), int hidden_link = -1);

  /** Files that could not be read so far, one sentence each. */
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  struct Entry {
    /** Keeps the model alive. */
    std::shared_ptr<const RobotModel> model;
    std::unique_ptr<RobotVisual> visual;
  };

  SceneRenderer& renderer_;
  std::unique_ptr<RobotVisual> own_;
  std::map<const RobotModel*, Entry> others_;
  std::vector<std::string> problems_;
};

}  // namespace nao
