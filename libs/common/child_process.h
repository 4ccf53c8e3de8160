#pragma once

#include <sys/types.h>

#include <csignal>
#include <string>
#include <vector>

namespace nao {

/** A program that a benchmark or test starts and ends. It starts with normal scheduling, whatever
 * the scheduling of the parent. */
class ChildProcess {
 public:
  /** Destination of the program's stdout and stderr. */
  enum class Output { kInherit, kFile };

  /** @param command  Path and arguments.
   * @param output  kFile: a file in the temporary folder, see output().
   * @throws Error  if it cannot be started. */
  explicit ChildProcess(const std::vector<std::string>& command, Output output = Output::kFile);
  /** Ends it with SIGTERM, after 5 s with SIGKILL, if it still runs. */
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }

  /** Sends a signal and waits for the end. @return As wait(). */
  int end(int signal = SIGTERM);

  /** Waits for the end; at most once.
   * @return Exit status, or minus the signal that ended it; 127 if there is no such program. */
  int wait();

  /** CPU time of all its threads, s. */
  double cpu_seconds() const;

  /** Resident memory, MiB. */
  double rss_mib() const;

  /** Its output so far; empty with Output::kInherit. */
  std::string output() const;

 private:
  /** -1 after its end. */
  pid_t pid_ = -1;
  std::string output_file_;
};

/** Folder of the running program and of the project's other programs. */
std::string program_folder();

}  // namespace nao
