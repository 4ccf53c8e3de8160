#include "rendering/scene_surroundings.h"

#include "common/error.h"
#include "rendering/scene_renderer.h"

namespace nao {
namespace {

/** Ball of the RoboCup standard platform league, m; the scene "soccer" has the same. */
constexpr double kStandardBallRadius = 0.05;

}  // namespace

bool SceneSurroundings::set(const std::string& name) {
  if (name_ == name) return false;
  name_ = name;
  file_ = {};
  problem_.clear();
  try {
    // Without the scene's file, everything else is still drawn.
    file_ = SceneFile::find(name);
  } catch (const Error& error) {
    problem_ = std::string(error.what()) + "; a plain floor is drawn";
  }
  renderer_.set_surroundings(file_);
  return true;
}

double SceneSurroundings::ball_radius() const {
  return file_.ball ? file_.ball->radius : kStandardBallRadius;
}

}  // namespace nao
