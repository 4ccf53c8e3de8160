#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <naolcm/daemon_status_t.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/error.h"
#include "common/joined.h"
#include "common/local_multicast.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "tools/nao/bus_listener.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

/** Timeout of the round trip, s. Measured round trips take less than 1 ms. */
constexpr double kEchoDeadline = 1.0;
/** Listening time, s: longer than the period of daemon_status_t, 1 s. */
constexpr double kListenTime = 1.3;
/** Listening time for a channel that must be silent, s: longer than the longest period of a state,
 * 0.2 s of match_state_t. */
constexpr double kSilenceTime = 0.3;
/** Longest time between two looks at the bus, s. Chosen: its buffer holds much more. */
constexpr double kListenPeriod = 0.02;
/** Receive buffer that holds a burst of images for several phones, bytes. A smaller one may
 * overflow. */
constexpr double kRecommendedBufferBytes = 2e6;
/** Maximum clock difference at which wall times of two hosts are comparable, s. */
constexpr double kClockTolerance = 0.1;
constexpr const char* kEchoChannel = "BUS_CHECK";
constexpr const char* kSeparateSystems =
    "give one of them a bus of its own (another port: --lcm-url "
    "\"udpm://239.255.76.67:7668?ttl=0\"), or its robots other names (--robot NAME)";

/** What to check. */
struct BusCheck {
  bool is_quick = false;
  std::vector<std::string> own_channels;
};

/** Local address from which the system sends to a multicast group.
 * @return nullopt if there is no route; errno then holds the reason. */
std::optional<in_addr> local_address_towards(const BusAddress& address) {
  sockaddr_in target{};
  target.sin_family = AF_INET;
  target.sin_port = htons(static_cast<uint16_t>(address.port));
  if (inet_pton(AF_INET, address.group.c_str(), &target.sin_addr) != 1) {
    throw ConfigError("'" + address.group + "' is not an IPv4 address");
  }
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in local{};
  socklen_t size = sizeof local;
  const bool has_route =
      connect(descriptor, reinterpret_cast<sockaddr*>(&target), sizeof target) == 0 &&
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&local), &size) == 0;
  close(descriptor);
  if (!has_route) return std::nullopt;
  return local.sin_addr;
}

std::string interface_with(const in_addr& address) {
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) != 0) return "?";
  std::string name = "?";
  for (const ifaddrs* i = interfaces; i != nullptr; i = i->ifa_next) {
    if (i->ifa_addr == nullptr || i->ifa_addr->sa_family != AF_INET) continue;
    if (reinterpret_cast<sockaddr_in*>(i->ifa_addr)->sin_addr.s_addr == address.s_addr) {
      name = i->ifa_name;
      break;
    }
  }
  freeifaddrs(interfaces);
  return name;
}

/** Sends a message to this process. @return Round-trip time, s; nullopt if it did not arrive. */
std::optional<double> echo_time(Bus& bus) {
  const int64_t own_id = wall_utime();
  bool has_arrived = false;
  bus.subscribe<naolcm::daemon_status_t>(kEchoChannel, Bus::Queue::kAll, [&](const auto& status) {
    has_arrived |= status.wall_utime == own_id && status.process_id == getpid();
  });
  naolcm::daemon_status_t status{};
  status.wall_utime = own_id;
  status.program = "nao-bus";
  status.process_id = getpid();
  const double start = monotonic_seconds();
  bus.publish(kEchoChannel, status);
  while (!has_arrived && monotonic_seconds() - start < kEchoDeadline) bus.handle_for(0.05);
  if (!has_arrived) return std::nullopt;
  return monotonic_seconds() - start;
}

/** Programs and clock of one host. */
struct HostReport {
  std::map<std::string, std::set<int>> processes;
  /** Minimum measured difference of its clock to ours, s: the sample with the lowest latency. */
  double clock_difference = std::nan("");
};

std::map<std::string, HostReport> listen_for_hosts(Bus& bus, BusListener& listener,
                                                   ChannelOwners& owners) {
  std::map<std::string, HostReport> hosts;
  bus.subscribe<naolcm::daemon_status_t>(
      kDaemonStatusChannel, Bus::Queue::kAll, [&hosts](const auto& status) {
        HostReport& host = hosts[status.host];
        host.processes[status.program].insert(status.process_id);
        const double difference = static_cast<double>(wall_utime() - status.wall_utime) * 1e-6;
        if (!(std::abs(difference) >= std::abs(host.clock_difference))) {
          host.clock_difference = difference;
        }
      });
  const double end = monotonic_seconds() + kListenTime;
  while (monotonic_seconds() < end) {
    bus.handle_for(kListenPeriod);
    listener.read(owners);
  }
  return hosts;
}

void report_buffer() {
  double bytes = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> bytes;
  const bool is_enough = bytes >= kRecommendedBufferBytes;
  std::printf("%s  receive buffer: up to %.0f kB%s\n", is_enough ? "ok  " : "note", bytes / 1000,
              is_enough ? ""
                        : "; if programs report dropped messages: sysctl -w "
                          "net.core.rmem_max=2097152");
}

/** @return false if two systems share the bus. */
bool report_owners(const ChannelOwners& owners) {
  const std::vector<std::string> shared = owners.find_shared();
  for (const std::string& channel : shared) {
    std::printf("FAIL  two systems share this bus: two programs publish on %s: %s\n",
                channel.c_str(), joined(owners.owners_of(channel)).c_str());
  }
  if (!shared.empty()) std::printf("      fix it: %s\n", kSeparateSystems);
  return shared.empty();
}

/** What a system is about to publish must be silent. Its owner is named if it publishes its status.
 * @return false if it is not. */
bool check_silence(BusListener& listener, const std::vector<std::string>& channels) {
  ChannelOwners owners;
  const auto listen_until = [&](double end) {
    while (monotonic_seconds() < end) {
      pollfd waiting{listener.descriptor(), POLLIN, 0};
      (void)poll(&waiting, 1, static_cast<int>(kListenPeriod * 1e3));
      listener.read(owners);
    }
  };
  const auto is_taken = [&](const std::string& channel) {
    return !owners.owners_of(channel).empty();
  };
  const double start = monotonic_seconds();
  listen_until(start + kSilenceTime);
  if (std::none_of(channels.begin(), channels.end(), is_taken)) return true;
  listen_until(start + kListenTime);
  for (const std::string& channel : channels) {
    if (!is_taken(channel)) continue;
    std::printf("FAIL  another system publishes on %s already: %s\n", channel.c_str(),
                joined(owners.owners_of(channel)).c_str());
  }
  std::printf("      fix it: end it, or %s\n", kSeparateSystems);
  return false;
}

/** Other hosts are reached by one interface.
 * @return false if it is not that of the default route, and nobody is heard there. */
bool report_reach(const std::string& url, const std::string& interface, bool has_other_host) {
  if (is_local_bus(url) || has_other_host) return true;
  // An address of no host (RFC 5737): the interface of the default route.
  const auto usual = local_address_towards({"192.0.2.1", 7667});
  const std::string usual_interface = usual ? interface_with(*usual) : interface;
  const bool is_usual = usual_interface == interface;
  std::printf(
      "%s  no program of another host is heard; messages to other hosts leave by %s only%s. If "
      "they are in another network: ip route replace 239.255.76.0/24 dev INTERFACE\n",
      is_usual ? "note" : "FAIL", interface.c_str(),
      is_usual ? "" : (", and the default route goes by " + usual_interface).c_str());
  return is_usual;
}

/** @return false if something is wrong. */
bool report_hosts(const std::map<std::string, HostReport>& hosts) {
  bool are_clocks_fine = true;
  if (hosts.empty()) std::printf("note  no program publishes its status on this bus\n");
  for (const auto& [name, host] : hosts) {
    std::string programs;
    for (const auto& [program, processes] : host.processes) {
      programs += " " + program;
      if (processes.size() > 1) {
        programs += " (" + std::to_string(processes.size()) + " of them)";
      }
    }
    const bool is_clock_fine = std::abs(host.clock_difference) < kClockTolerance;
    are_clocks_fine &= is_clock_fine;
    std::printf("%s  host %s:%s; clock difference %.3f s%s\n", is_clock_fine ? "ok  " : "FAIL",
                name.c_str(), programs.c_str(), host.clock_difference,
                is_clock_fine ? "" : "; synchronize both with the same time server");
  }
  return are_clocks_fine;
}

std::string own_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

int run_bus_check(const std::string& url, const BusCheck& check) {
  const BusAddress address = parse_bus_address(url);
  std::printf("bus   %s\n", url.c_str());
  const auto local = local_address_towards(address);
  if (!local) {
    const std::string network = address.group.substr(0, address.group.rfind('.')) + ".0/24";
    std::printf("FAIL  no route to %s: %s\n", address.group.c_str(), std::strerror(errno));
    std::printf("      fix it: ip link set lo up multicast on && ip route add %s dev lo\n",
                network.c_str());
    return 1;
  }
  const std::string interface = interface_with(*local);
  if (interface == "lo" && !is_local_bus(url) && !check.is_quick) {
    std::printf(
        "FAIL  the route to %s goes by lo, so no other host hears this one\n"
        "      fix it: ip route replace %s/32 dev INTERFACE, the one to the other hosts; or use "
        "?ttl=0 if there are none\n",
        address.group.c_str(), address.group.c_str());
    return 1;
  }
  std::printf("ok    route to %s by interface %s\n", address.group.c_str(), interface.c_str());
  Bus bus(url);
  const auto echo = echo_time(bus);
  if (!echo) {
    std::printf("FAIL  a test message did not return within %.0f s\n", kEchoDeadline);
    std::printf(
        "      fix it: ip link set %s multicast on, and let the firewall pass UDP port %d\n",
        interface.c_str(), address.port);
    return 1;
  }
  std::printf("ok    a test message returned in %.2f ms\n", *echo * 1000);
  if (check.is_quick && check.own_channels.empty()) return 0;
  BusListener listener(address);
  if (!check.own_channels.empty() && !check_silence(listener, check.own_channels)) return 1;
  if (check.is_quick) return 0;
  ChannelOwners owners;
  const auto hosts = listen_for_hosts(bus, listener, owners);
  report_buffer();
  const bool are_clocks_fine = report_hosts(hosts);
  const bool is_reach_fine = report_reach(url, interface, hosts.size() > hosts.count(own_name()));
  return report_owners(owners) && are_clocks_fine && is_reach_fine ? 0 : 1;
}

}  // namespace

void add_bus_command(CommandLine& app, Invocation& invocation) {
  auto check = std::make_shared<BusCheck>();
  CommandLine* bus = app.add_subcommand("bus",
                                        "Check the message bus: route, loopback, buffers, other "
                                        "hosts, two systems on one bus; print how "
                                        "to fix faults");
  bus->add_flag("--quick", check->is_quick, "Check only route and loopback");
  bus->add_option(
      "--own", check->own_channels,
      "Channels that a system is about to publish, such as NAO_SENSOR_STATE: nobody may "
      "publish on them yet (repeatable)");
  invocation.on(*bus,
                [check](const auto& common) { return run_bus_check(common.lcm_url, *check); });
}

}  // namespace nao
