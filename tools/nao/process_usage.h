#pragma once

#include <optional>

namespace nao {

/** Resources used by a process of this host. */
struct ProcessUsage {
  /** CPU time on all cores, s. */
  double cpu_seconds = 0;
  /** Resident memory, bytes. */
  double memory_bytes = 0;
};

/** Reads /proc. @return nullopt if there is no such process. */
std::optional<ProcessUsage> read_process_usage(int process_id);

}  // namespace nao
