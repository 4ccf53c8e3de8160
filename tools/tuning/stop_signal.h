#pragma once

#include <csignal>

namespace nao {

/** While one exists, SIGINT and SIGUSR1 (which mpirun passes on to its processes) set a flag
 * instead of ending the process; a second SIGINT ends it. */
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  bool has_come() const;

 private:
  struct sigaction old_interrupt_ = {};
  struct sigaction old_user_ = {};
};

}  // namespace nao
