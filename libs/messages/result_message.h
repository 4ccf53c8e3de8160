#pragma once

#include <cstdint>
#include <naolcm/command_result_t.hpp>

#include "messages/command.h"

namespace nao {

/** @param utime  Robot time, microseconds. */
naolcm::command_result_t to_message(const CommandResult& result, int64_t utime);

}  // namespace nao
