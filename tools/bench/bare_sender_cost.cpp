#include "tools/bench/bare_sender_cost.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/child_process.h"
#include "common/wall_clock.h"
#include "tools/bench/ports.h"

namespace nao::bench {
namespace {

// The program divides by its rates, 1/s. Chosen: next to nothing.
constexpr double kLeastRate = 0.1;

}  // namespace

double measure_bare_sender(const SentTraffic& traffic, int num_clients, double time) {
  const auto rate = [](double value) { return std::to_string(std::max(kLeastRate, value)); };
  const auto bytes = [](double value) {
    return std::to_string(std::max(1, static_cast<int>(value)));
  };
  const ChildProcess sender({program_folder() + "/nao-bare-sender", rate(traffic.state_rate),
                             bytes(traffic.state_bytes), rate(traffic.image_rate),
                             bytes(traffic.image_bytes)});
  const uint16_t port = wait_for_port(sender, "port ");
  std::vector<pollfd> polled;
  for (int i = 0; i < num_clients; ++i) polled.push_back({connect_to_own_host(port), POLLIN, 0});
  const double cpu_before = sender.cpu_seconds();
  const double start = monotonic_seconds();
  std::vector<char> part(65536);
  while (monotonic_seconds() < start + time) {
    poll(polled.data(), polled.size(), 100);
    for (const pollfd& one : polled) {
      if (one.revents != 0 && recv(one.fd, part.data(), part.size(), 0) <= 0) {
        throw std::runtime_error("the bare sender ended");
      }
    }
  }
  const double percent = (sender.cpu_seconds() - cpu_before) / (monotonic_seconds() - start) * 100;
  for (const pollfd& one : polled) close(one.fd);
  return percent;
}

}  // namespace nao::bench
