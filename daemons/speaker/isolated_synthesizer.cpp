#include "daemons/speaker/isolated_synthesizer.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <string>

#include "common/logger.h"

namespace nao::speaker {
namespace {

/** Writes all of the bytes. */
bool write_all(int fd, const void* data, size_t num_bytes) {
  const char* position = static_cast<const char*>(data);
  while (num_bytes > 0) {
    const ssize_t num_written = write(fd, position, num_bytes);
    if (num_written < 0 && errno == EINTR) continue;
    if (num_written <= 0) return false;
    position += num_written;
    num_bytes -= static_cast<size_t>(num_written);
  }
  return true;
}

/** Reads until the other end closes. */
std::string read_all(int fd) {
  std::string bytes;
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t num_read = read(fd, buffer.data(), buffer.size());
    if (num_read < 0 && errno == EINTR) continue;
    if (num_read <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<size_t>(num_read));
  }
}

/** The child process: writes the sample rate and the samples.
 * @return Its exit status. */
int run_child(Synthesizer& synthesizer, const SpeechCommand& command, int max_processor_time,
              int fd) {
  const rlimit limit{static_cast<rlim_t>(max_processor_time),
                     static_cast<rlim_t>(max_processor_time)};
  const rlimit no_core{0, 0};
  if (setrlimit(RLIMIT_CPU, &limit) != 0 || setrlimit(RLIMIT_CORE, &no_core) != 0) return 1;
  try {
    const std::optional<Speech> speech = synthesizer.synthesize(command);
    if (!speech) return 1;
    const auto num_bytes = speech->samples.size() * sizeof(int16_t);
    const bool is_written = write_all(fd, &speech->sample_rate, sizeof speech->sample_rate) &&
                            write_all(fd, speech->samples.data(), num_bytes);
    return is_written ? 0 : 1;
  } catch (const std::exception&) {
    return 1;
  }
}

/** "signal 11 (Segmentation fault)". */
std::string describe(int status) {
  if (!WIFSIGNALED(status)) return "exit status " + std::to_string(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

}  // namespace

IsolatedSynthesizer::IsolatedSynthesizer(Synthesizer& synthesizer, int max_processor_time)
    : synthesizer_(synthesizer), max_processor_time_(max_processor_time) {}

std::optional<Speech> IsolatedSynthesizer::synthesize(const SpeechCommand& command) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) {
    logger::error("no pipe for the speech synthesizer: {}", std::strerror(errno));
    return std::nullopt;
  }
  const pid_t child = fork();
  if (child == 0) _exit(run_child(synthesizer_, command, max_processor_time_, ends[1]));
  close(ends[1]);
  if (child < 0) {
    logger::error("no process for the speech synthesizer: {}", std::strerror(errno));
    close(ends[0]);
    return std::nullopt;
  }
  const std::string bytes = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  Speech speech;
  if (status != 0 || bytes.size() < sizeof speech.sample_rate) {
    logger::warn(
        "a text of {} bytes, language {}, could not be spoken: the synthesizer ended with {}",
        command.text.size(), command.language, describe(status));
    return std::nullopt;
  }
  std::memcpy(&speech.sample_rate, bytes.data(), sizeof speech.sample_rate);
  speech.samples.resize((bytes.size() - sizeof speech.sample_rate) / sizeof(int16_t));
  std::copy_n(bytes.data() + sizeof speech.sample_rate, speech.samples.size() * sizeof(int16_t),
              reinterpret_cast<char*>(speech.samples.data()));
  return speech;
}

}  // namespace nao::speaker
