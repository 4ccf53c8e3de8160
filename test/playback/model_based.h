#pragma once

#include "daemons/motion/motion_options.h"

namespace nao::playback {

/** Robots of recorded sessions get up by transitions: the sums of a network differ by processor. */
inline motion::MotionOptions model_based() {
  motion::MotionOptions options;
  options.policy = motion::kNoPolicy;
  return options;
}

}  // namespace nao::playback
