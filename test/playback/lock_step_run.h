#pragma once

#include <string>
#include <vector>

#include "common/log_reader.h"
#include "test/playback/course.h"

namespace nao::playback {

/** Plays commands to simulator and motion, which run in lock-step on a bus inside this process:
 * each command is on the bus at the tick at which it was when it was recorded.
 * @param after  Time for which to observe after the last command, robot s. @throws Error  if this
 * version does not have a message's type. */
Course run_in_lock_step(const std::vector<LogEvent>& commands, double after);

}  // namespace nao::playback
