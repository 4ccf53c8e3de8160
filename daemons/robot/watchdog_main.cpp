// Starts nao-robot, and takes over when it dies or hangs: a robot keeps its stiffness when its
// program has ended. Ends after that; supervisor or systemd restarts it.
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>
#include <vector>

#include "common/child_process.h"
#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/logger.h"
#include "common/program.h"
#include "daemons/robot/robot_options.h"
#include "daemons/robot/take_over.h"
#include "robot_model/robot_model.h"

namespace nao::robot {
namespace {

/** Heartbeats that may be missing before nao-robot counts as hung: 0.3 s. Chosen: two and a half
 * times the time without commands after which nao-robot itself makes the robot sit down. They are
 * counted by this process's own waits, so that a pause of the whole machine does not count as a
 * hang. */
constexpr int kMaxMissed = 15;
/** The same before the first heartbeat, 10 s: it loads the robot's model, on a busy machine. */
constexpr int kMaxMissedAtStart = 500;

/** nao-robot as a child process, and its heartbeat. */
class Child {
 public:
  explicit Child(std::vector<std::string> command) {
    std::array<int, 2> ends{};
    // Neither end blocks: a hung child must not hang its watchdog.
    if (pipe2(ends.data(), O_NONBLOCK) != 0) throw Error("cannot make a pipe");
    heartbeat_ = ends[0];
    // The child inherits the writing end only.
    fcntl(heartbeat_, F_SETFD, FD_CLOEXEC);
    command.insert(command.end(), {"--heartbeat", std::to_string(ends[1])});
    std::vector<char*> words;
    for (std::string& word : command) words.push_back(word.data());
    words.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) throw Error("cannot start nao-robot");
    if (pid_ == 0) {
      // Without a watchdog, the child ends in an orderly way.
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      execv(words[0], words.data());
      // The exit status of a shell for a program that it cannot start.
      _exit(127);
    }
    close(ends[1]);
  }

  int heartbeat() const { return heartbeat_; }
  void send(int signal) const { kill(pid_, signal); }
  /** @return Whether there was one since the last call. */
  bool take_heartbeats() const {
    std::array<char, 64> bytes;
    bool has_any = false;
    while (read(heartbeat_, bytes.data(), bytes.size()) > 0) has_any = true;
    return has_any;
  }
  /** @return Whether it has ended. */
  bool has_ended() {
    has_ended_ = has_ended_ || waitpid(pid_, &status_, WNOHANG) == pid_;
    return has_ended_;
  }
  void kill_and_wait() {
    send(SIGKILL);
    waitpid(pid_, &status_, 0);
    has_ended_ = true;
  }
  bool has_succeeded() const { return WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }

 private:
  pid_t pid_ = -1;
  int heartbeat_ = -1;
  int status_ = 0;
  bool has_ended_ = false;
};

/** Blocks until the child has ended or hangs, and passes signals on. @return Why it must be taken
 * over; empty if it has ended by itself. */
std::string watch(Child& child, int signals) {
  bool has_begun = false;
  int num_missed = 0;
  // The loop ends when the child ends or falls silent.
  while (!child.has_ended()) {
    // The heartbeat is not polled: it stays readable after the child has ended.
    pollfd polled{signals, POLLIN, 0};
    poll(&polled, 1, static_cast<int>(kHeartbeatPeriod * 1e3));
    signalfd_siginfo signal{};
    if (read(signals, &signal, sizeof signal) == sizeof signal && signal.ssi_signo != SIGCHLD) {
      // SIGINT of a terminal reaches the whole process group; SIGTERM twice does no harm.
      child.send(SIGTERM);
      continue;
    }
    if (child.take_heartbeats()) {
      has_begun = true;
      num_missed = 0;
    } else if (++num_missed > (has_begun ? kMaxMissed : kMaxMissedAtStart)) {
      child.kill_and_wait();
      return "nao-robot hung and was killed";
    }
  }
  return child.has_succeeded() ? "" : "nao-robot died";
}

int run(const RobotOptions& options, const std::vector<std::string>& arguments) {
  const RobotModel model = RobotModel::find(options.model);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&signals, signal);
  std::vector<std::string> command = arguments;
  command.insert(command.begin(), program_folder() + "/nao-robot");
  Child child(command);
  // Blocked after the child was started, which must not inherit it.
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  const int descriptor = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  if (descriptor < 0) throw Error("cannot create a signal descriptor");
  const std::string reason = watch(child, descriptor);
  if (reason.empty()) return 0;
  // From here on the robot has no program: it must be made limp before this one ends.
  logger::error("{}; taking over", reason);
  logger::warn("{}", take_over(model, options.lola_socket));
  return 1;
}

}  // namespace
}  // namespace nao::robot

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Runs nao-robot with the same options. If that dies or hangs, this program kills it, makes "
      "the "
      "robot sit down and go limp, and ends with status 1.",
      "nao-robot-watchdog");
  nao::CommonOptions common;
  nao::add_common_options(app, common);
  nao::robot::RobotOptions options;
  nao::robot::add_robot_options(app, options);
  return nao::run_program_with_status(app, common, argc, argv, [&] {
    return nao::robot::run(options, std::vector<std::string>(argv + 1, argv + argc));
  });
}
