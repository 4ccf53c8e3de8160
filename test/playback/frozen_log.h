#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/log_reader.h"

namespace nao::playback {

/** Every message of a frozen log, in order; `wall_utime` is the robot time, microseconds, at which
 * it passed.
 * @throws Error  if there is none. */
std::vector<LogEvent> read_frozen_log(const std::filesystem::path& file);

/** Sends a logged message on a bus: a command, sensors, or the truth. @throws Error  if this
 * version does not have its type; the sentence says how to record it again. */
void send(Bus& bus, const LogEvent& event);

}  // namespace nao::playback
