#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace nao {

/** A program that a benchmark starts and ends. It takes usual turns until it asks for others,
 * however the benchmark itself runs. */
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

  /** Processor time that it has used, all threads, s. */
  double cpu_seconds() const;

  /** Memory that it holds, MiB. */
  double rss_mib() const;

  /** What it has printed so far. */
  std::string output() const;

 private:
  pid_t pid_ = -1;
  std::string output_file_;
};

/** The folder of the running program, where the others lie. */
std::string program_folder();

}  // namespace nao
