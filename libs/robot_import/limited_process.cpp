#include "robot_import/limited_process.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>

#include "common/error.h"

namespace nao {
namespace {

// First byte of what the child sends: a result or the text of an error follows.
constexpr char kResult = '+';
constexpr char kError = '-';

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasSanitizer = true;
#else
constexpr bool kHasSanitizer = false;
#endif

bool limit(int resource, size_t value) {
  const rlimit bounds{static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
  return setrlimit(resource, &bounds) == 0;
}

std::string memory_text(const ProcessLimits& limits) {
  return "needs more than " + std::to_string(limits.memory >> 20U) + " MiB of memory";
}

std::string run_task(const std::function<std::string()>& task, const ProcessLimits& limits) {
  if (!limit(RLIMIT_CPU, static_cast<size_t>(limits.processor_time)) || !limit(RLIMIT_CORE, 0) ||
      (!kHasSanitizer && !limit(RLIMIT_AS, limits.memory))) {
    return kError + std::string("its process cannot be limited");
  }
  try {
    return kResult + task();
  } catch (const std::bad_alloc&) {
    return kError + memory_text(limits);
  } catch (const std::exception& error) {
    return kError + std::string(error.what());
  }
}

[[noreturn]] void run_child(const std::function<std::string()>& task, const ProcessLimits& limits,
                            int fd) {
  const std::string bytes = run_task(task, limits);
  size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t written = write(fd, bytes.data() + sent, bytes.size() - sent);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    sent += static_cast<size_t>(written);
  }
  _exit(sent == bytes.size() ? 0 : 1);
}

std::string read_all(int fd) {
  std::string bytes;
  std::array<char, 65536> buffer{};
  while (true) {
    const ssize_t count = read(fd, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<size_t>(count));
  }
}

}  // namespace

std::string run_limited(const std::function<std::string()>& task, const ProcessLimits& limits) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw ModelError(std::string("no pipe: ") + std::strerror(errno));
  const pid_t child = fork();
  if (child == 0) run_child(task, limits, ends[1]);
  close(ends[1]);
  std::string bytes;
  if (child > 0) bytes = read_all(ends[0]);
  close(ends[0]);
  if (child < 0) throw ModelError(std::string("no process: ") + std::strerror(errno));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    // SIGKILL: the hard limit.
    const bool is_late = signal == SIGXCPU || signal == SIGKILL;
    throw ModelError(is_late ? "takes more than " + std::to_string(limits.processor_time) + " s"
                             : std::string("makes its reader crash: ") + strsignal(signal));
  }
  if (status != 0 || bytes.empty()) throw ModelError("its reader failed");
  if (bytes.front() == kError) throw ModelError(bytes.substr(1));
  return bytes.substr(1);
}

}  // namespace nao
