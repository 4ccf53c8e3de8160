#pragma once

#include <optional>
#include <string>

#include "robot_model/scene_file.h"

namespace nao {

class SceneRenderer;

/** Loads the scene file that a message names, and sets the renderer's ground and goals from it. */
class SceneSurroundings {
 public:
  /** @param renderer  Must outlive this. */
  explicit SceneSurroundings(SceneRenderer& renderer) : renderer_(renderer) {}

  /** Loads a scene unless it is the current one; an unknown one gives a plain floor.
   * @return true if the scene has changed. */
  bool set(const std::string& name);

  /** Why the current scene could not be loaded; empty if it could. */
  const std::string& problem() const { return problem_; }

  /** Nothing without a field, or before set(). */
  const std::optional<FieldDimensions>& field() const { return file_.field; }
  /** Radius of the ball, m; of the standard one if the scene has none. */
  double ball_radius() const;

 private:
  SceneRenderer& renderer_;
  std::optional<std::string> name_;
  SceneFile file_;
  std::string problem_;
};

}  // namespace nao
