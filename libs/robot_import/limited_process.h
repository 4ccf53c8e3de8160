#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace nao {

/** Limits of a process. */
struct ProcessLimits {
  /** s. */
  int processor_time = 20;
  /** Address space, bytes; not applied in builds with sanitizers, which reserve far more. */
  size_t memory = size_t{2} << 30U;
};

/** Runs a task in a child process, which may crash or exceed its limits without harm to this one:
 * for libraries that read files of unknown origin. This process should have one thread, as locks
 * that another one holds stay locked in the child.
 * @param task  Its effects other than its result and files are lost.
 * @return What the task returned.
 * @throws ModelError  with the text of the task's own exception, or with how the process ended. */
std::string run_limited(const std::function<std::string()>& task, const ProcessLimits& limits);

}  // namespace nao
