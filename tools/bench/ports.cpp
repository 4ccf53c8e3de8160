#include "tools/bench/ports.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "common/wall_clock.h"

namespace nao::bench {
namespace {

// Time until a program must listen, s. Chosen: no measurement, only the end of a benchmark that
// cannot go on.
constexpr double kDeadline = 60;

}  // namespace

uint16_t wait_for_port(const ChildProcess& program, const std::string& label) {
  std::string output;
  size_t begin = 0;
  size_t end = 0;
  const double deadline = monotonic_seconds() + kDeadline;
  // The word is whole when something follows it.
  while (end == 0) {
    if (monotonic_seconds() > deadline) throw std::runtime_error("no port is open:\n" + output);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    output = program.output();
    begin = output.find(label);
    if (begin == std::string::npos) continue;
    begin += label.size();
    end = output.find_first_of(", \n", begin) + 1;
  }
  const std::string word = output.substr(begin, end - 1 - begin);
  return static_cast<uint16_t>(std::stoi(word.substr(word.rfind(':') + 1)));
}

int connect_to_own_host(uint16_t port) {
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    close(descriptor);
    throw std::runtime_error("nothing listens on port " + std::to_string(port));
  }
  const int on = 1;
  setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return descriptor;
}

}  // namespace nao::bench
