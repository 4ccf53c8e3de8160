#include "tools/bench/ports.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "common/wall_clock.h"
#include "tools/bench/deadline.h"

namespace nao::bench {
uint16_t wait_for_port(const ChildProcess& program, const std::string& label) {
  const double deadline = monotonic_seconds() + kDeadline;
  while (monotonic_seconds() < deadline) {
    const std::string output = program.output();
    const size_t found = output.find(label);
    if (found != std::string::npos) {
      const size_t begin = found + label.size();
      // The word is whole when something follows it.
      const size_t end = output.find_first_of(", \n", begin);
      if (end != std::string::npos) {
        const std::string word = output.substr(begin, end - begin);
        return static_cast<uint16_t>(std::stoi(word.substr(word.rfind(':') + 1)));
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  throw std::runtime_error("no port is open:\n" + program.output());
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
