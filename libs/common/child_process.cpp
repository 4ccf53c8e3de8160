#include "common/child_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "common/error.h"
#include "common/processor_time.h"
#include "common/scheduling.h"

namespace nao {

ChildProcess::ChildProcess(const std::vector<std::string>& command, Output output) {
  int file = -1;
  if (output == Output::kFile) {
    // A file and not a pipe: a pipe that nobody reads would block the child.
    std::string pattern = (std::filesystem::temp_directory_path() / "nao-child-XXXXXX").string();
    // Closed by execv(): the child keeps it as its standard output only.
    file = mkostemp(pattern.data(), O_CLOEXEC);
    if (file < 0) throw Error("cannot create " + pattern + " for a program's output");
    output_file_ = pattern;
  }
  std::vector<char*> arguments;
  // execv() takes char*, and does not write to the strings.
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    // Between fork() and execv() only calls that change this process: the child has no other thread
    // of the parent.
    use_normal_scheduling();
    // The parent's EventLoop may have blocked SIGTERM; the mask survives execv().
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    if (file >= 0) {
      dup2(file, STDOUT_FILENO);
      dup2(file, STDERR_FILENO);
    }
    execv(arguments[0], arguments.data());
    // As a shell reports a program that it cannot start.
    _exit(127);
  }
  if (file >= 0) close(file);
  if (pid_ < 0) throw Error("cannot start " + command.at(0));
}

// SIGTERM first, so that the program leaves the robot safe; SIGKILL after five seconds.
ChildProcess::~ChildProcess() {
  if (pid_ > 0) {
    using std::chrono::steady_clock;
    const auto deadline = steady_clock::now() + std::chrono::seconds(5);
    kill(pid_, SIGTERM);
    while (waitpid(pid_, nullptr, WNOHANG) == 0) {
      if (steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      } else {
        // A program that hangs must not make its parent wait for ever.
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
        break;
      }
    }
  }
  std::error_code ignored;
  if (!output_file_.empty()) std::filesystem::remove(output_file_, ignored);
}

int ChildProcess::end(int signal) {
  kill(pid_, signal);
  return wait();
}

int ChildProcess::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  // Negative: the signal that ended it.
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

double ChildProcess::cpu_seconds() const {
  clockid_t clock{};
  if (clock_getcpuclockid(pid_, &clock) != 0) return 0;
  return clock_seconds(clock);
}

double ChildProcess::rss_mib() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/statm");
  double total_pages = 0;
  double resident_pages = 0;
  // Source: proc(5), statm: total program size, resident set, in pages.
  file >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024 * 1024);
}

std::string ChildProcess::output() const {
  std::ifstream file(output_file_);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

}  // namespace nao
