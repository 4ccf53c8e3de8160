#include "sim/engine.h"

#include "common/error.h"
#include "sim/simbody_engine.h"
#include "sim/stepper.h"
#ifdef NAO_HAS_MUJOCO
#include "sim/mujoco_engine.h"
#endif

namespace nao::sim {

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
