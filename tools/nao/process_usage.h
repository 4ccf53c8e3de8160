#pragma once

#include <optional>

namespace nao {

/** What a process of this machine has used so far. */
struct ProcessUsage {
  /** Time on any core, s. */
  double cpu_seconds = 0;
  /** Resident memory, bytes. */
  double memory_bytes = 0;
};

/** Reads it from /proc. @return Nothing if there is no such process. */
std::optional<ProcessUsage> read_process_usage(int process_id);

}  // namespace nao
