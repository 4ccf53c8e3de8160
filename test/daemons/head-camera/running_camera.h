#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nao {

/** The program nao-head-camera, which runs next to the test. */
inline std::string camera_program() {
  return std::filesystem::canonical("/proc/self/exe").parent_path() / "nao-head-camera";
}

/** A bus that only this process uses. */
inline std::string private_url() {
  return "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
}

/** The program, running during the lifetime of this object. */
class RunningCamera {
 public:
  /** @param environment  Variables beyond the test's own, with their values. */
  explicit RunningCamera(std::vector<std::string> options,
                         const std::vector<std::pair<std::string, std::string>>& environment = {})
      : process_(fork()) {
    if (process_ != 0) return;
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    options.insert(options.begin(), camera_program());
    std::vector<char*> words;
    for (std::string& word : options) words.push_back(word.data());
    words.push_back(nullptr);
    execv(words.front(), words.data());
    _exit(127);
  }
  ~RunningCamera() {
    if (process_ > 0) stop();
  }
  RunningCamera(const RunningCamera&) = delete;
  RunningCamera& operator=(const RunningCamera&) = delete;

  /** Sends SIGTERM. @return The exit status. */
  int stop() {
    kill(process_, SIGTERM);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_;
};

}  // namespace nao
