#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace nao {

/** A program that a benchmark or test starts and ends. It starts with normal scheduling, whatever
 * the scheduling of the parent. */
class ChildProcess {
 public:
  /** @param command  Path and arguments. Its output goes to a file in the temporary folder.
   * @throws std::runtime_error  if it cannot be started. */
  explicit ChildProcess(const std::vector<std::string>& command);
  /** Ends it with SIGTERM and waits. */
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }

  /** CPU time of all its threads, s. */
  double cpu_seconds() const;

  /** Resident memory, MiB. */
  double rss_mib() const;

  /** Its output so far. */
  std::string output() const;

 private:
  pid_t pid_ = -1;
  std::string output_file_;
};

/** Folder of the running program and of the project's other programs. */
std::string program_folder();

}  // namespace nao
