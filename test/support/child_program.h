#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace nao {

/** Folder of this test program, where the project's programs are as well. */
inline std::filesystem::path program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

/** Bus of this test process alone: parallel test runs must not hear each other. */
inline std::string private_bus_url() {
  return "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
}

/** A program of the project, run as a child; ended with this object if it still runs. */
class ChildProgram {
 public:
  ChildProgram(const std::string& name, std::vector<std::string> arguments) {
    const std::string path = program_folder() / name;
    arguments.insert(arguments.begin(), path);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ == 0) {
      execv(path.c_str(), argv.data());
      _exit(127);
    }
  }
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;
  ~ChildProgram() {
    if (process_ > 0) end(SIGKILL);
  }

  /** Sends a signal and waits for the end.
   * @return Exit status, or minus the signal that ended it. */
  int end(int signal = SIGTERM) {
    kill(process_, signal);
    return wait();
  }

  int wait() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t process_ = -1;
};

}  // namespace nao
