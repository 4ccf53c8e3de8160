#pragma once

#include "daemons/motion/walk/gait.h"
#include "test/daemons/motion/nao_model.h"

namespace nao::motion {

/** The NAO's gait from the build tree's files, loaded once. */
inline const Gait& nao_gait() {
  static const Gait gait = Gait::load(nao_model().folder() / "gait.yaml");
  return gait;
}

}  // namespace nao::motion
