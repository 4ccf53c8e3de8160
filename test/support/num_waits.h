#pragma once

#include <fstream>
#include <string>

namespace nao {

/** How often a thread has waited for something, and so been woken.
 * @param thread_id  As in /proc; the id of a process is that of its first thread. */
inline int num_waits(int thread_id) {
  std::ifstream status("/proc/" + std::to_string(thread_id) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("voluntary_ctxt_switches:")) return std::stoi(line.substr(24));
  }
  return 0;
}

}  // namespace nao
