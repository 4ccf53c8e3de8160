#include "sim/engine.h"

#include "common/error.h"
#include "sim/simbody_engine.h"
#include "sim/stepper.h"
#ifdef NAO_HAS_MUJOCO
#include "sim/mujoco_engine.h"
#endif

namespace nao::sim {

void Engine::step_tick() {
  for (const auto& robot : bodies_.robots) robot->begin_tick();
  for (int i = 0; i < options_.steps_per_tick; ++i) step();
  for (int i = 0; i < bodies_.num_robots(); ++i) end_tick(i);
}

void Engine::end_tick(int index) {
  SimRobot& robot = *bodies_.robots[index];
  if (robot.is_within_bounds()) robot.end_tick(options_.period());
}

std::vector<std::string> engine_names() {
#ifdef NAO_HAS_MUJOCO
  return {"fast", "simbody", "mujoco"};
#else
  return {"fast", "simbody"};
#endif
}

// The engine of that name. An engine that is missing in this build is distinguished from an unknown
// one, since the first can be installed.
std::unique_ptr<Engine> make_engine(const SceneFile& scene, const WorldOptions& options,
                                    MovingBodies& bodies) {
  if (options.engine == "fast") return std::make_unique<Stepper>(scene, options, bodies);
  if (options.engine == "simbody") {
    return std::make_unique<SimbodyEngine>(scene, options, bodies);
  }
  if (options.engine == "mujoco") {
#ifdef NAO_HAS_MUJOCO
    return std::make_unique<MujocoEngine>(scene, options, bodies);
#else
    throw ConfigError(
        "this build has no engine \"mujoco\": install libmujoco-dev "
        "(scripts/setup --with optional) and build again");
#endif
  }
  std::string names;
  for (const std::string& name : engine_names()) names += (names.empty() ? "" : ", ") + name;
  throw ConfigError("there is no engine \"" + options.engine + "\"; this build has " + names);
}

}  // namespace nao::sim
