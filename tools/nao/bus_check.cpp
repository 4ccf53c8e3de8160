#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <naolcm/daemon_status_t.hpp>
#include <set>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/error.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "tools/nao/channel_owners.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

/** Timeout of the round trip, s. Measured round trips take less than 1 ms. */
constexpr double kEchoDeadline = 1.0;
/** Listening time, s: longer than the period of daemon_status_t, 1 s. */
constexpr double kListenTime = 1.3;
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

/** Address of a multicast bus. */
struct BusAddress {
  std::string group = "239.255.76.67";
  int port = 7667;
};

/** Reads udpm://GROUP:PORT?options; omitted parts have LCM's defaults.
 * @throws ConfigError  if the bus is of another kind or the port is invalid. */
BusAddress parse_address(const std::string& url) {
  const std::string scheme = "udpm://";
  if (!url.starts_with(scheme)) {
    throw ConfigError("only " + scheme + " buses can be checked, not " + url);
  }
  const std::string place = url.substr(scheme.size(), url.find('?') - scheme.size());
  const size_t colon = place.find(':');
  BusAddress address;
  if (colon != 0 && !place.empty()) address.group = place.substr(0, colon);
  if (colon != std::string::npos) {
    const std::string port = place.substr(colon + 1);
    const char* end = port.data() + port.size();
    if (const auto [rest, error] = std::from_chars(port.data(), end, address.port);
        rest != end || error != std::errc() || address.port < 1 || address.port > 65535) {
      throw ConfigError("'" + port + "' in " + url + " is not a port from 1 to 65535");
    }
  }
  return address;
}

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
  bus.subscribe<naolcm::daemon_status_t>(
      kEchoChannel, Bus::Queue::kAll, [&](const naolcm::daemon_status_t& status) {
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

/** Whether messages of a bus may leave this host: "?ttl=1" in its URL. */
bool reaches_other_hosts(const std::string& url) {
  const size_t ttl = url.find("ttl=");
  return ttl != std::string::npos && url.compare(ttl, 5, "ttl=0") != 0;
}

/** Programs and clock of one host. */
struct HostReport {
  std::map<std::string, std::set<int>> processes;
  /** Minimum measured difference of its clock to ours, s: the sample with the lowest latency. */
  double clock_difference = std::nan("");
};

std::map<std::string, HostReport> listen_for_hosts(Bus& bus, ChannelOwners& owners) {
  std::map<std::string, HostReport> hosts;
  bus.subscribe_raw(kOwnedChannels, [&](const RawMessage& message) {
    owners.note(message.channel, message.bytes.data(), static_cast<int>(message.bytes.size()));
  });
  bus.subscribe<naolcm::daemon_status_t>(
      kDaemonStatusChannel, Bus::Queue::kAll, [&hosts](const naolcm::daemon_status_t& status) {
        HostReport& host = hosts[status.host];
        host.processes[status.program].insert(status.process_id);
        const double difference = static_cast<double>(wall_utime() - status.wall_utime) * 1e-6;
        if (!(std::abs(difference) >= std::abs(host.clock_difference))) {
          host.clock_difference = difference;
        }
      });
  const double end = monotonic_seconds() + kListenTime;
  while (monotonic_seconds() < end) bus.handle_for(end - monotonic_seconds());
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

/** "nao-sim of host pc (process 12)": the processes of a program on all hosts. */
std::string list_processes(const std::map<std::string, HostReport>& hosts,
                           const std::string& program) {
  std::string list;
  for (const auto& [name, host] : hosts) {
    const auto processes = host.processes.find(program);
    if (processes == host.processes.end()) continue;
    for (const int process : processes->second) {
      list += (list.empty() ? "" : ", ") + program + " of host " + name + " (process " +
              std::to_string(process) + ")";
    }
  }
  return list;
}

/** The programs of which a bus has one, or that publish what a system publishes. */
std::string list_owners(const std::map<std::string, HostReport>& hosts) {
  std::string list;
  for (const char* program : {"nao-sim", "nao-robot", "nao-motion", "nao-referee"}) {
    const std::string processes = list_processes(hosts, program);
    if (!processes.empty()) list += (list.empty() ? "" : ", ") + processes;
  }
  return list.empty() ? "programs that publish no status" : list;
}

int count_processes(const std::map<std::string, HostReport>& hosts, const std::string& program) {
  int count = 0;
  for (const auto& [name, host] : hosts) {
    const auto processes = host.processes.find(program);
    if (processes != host.processes.end()) count += static_cast<int>(processes->second.size());
  }
  return count;
}

/** @return false if two systems share the bus. */
bool report_owners(const std::map<std::string, HostReport>& hosts, const ChannelOwners& owners) {
  std::string fault;
  for (const std::string& channel : owners.find_shared()) {
    fault += (fault.empty() ? "" : ", ") + channel;
  }
  if (!fault.empty()) fault = "two programs publish on " + fault;
  for (const char* program : {"nao-sim", "nao-referee"}) {
    if (fault.empty() && count_processes(hosts, program) > 1) {
      fault = std::string("there is more than one ") + program;
    }
  }
  if (fault.empty()) return true;
  std::printf("FAIL  two systems share this bus: %s: %s\n", fault.c_str(),
              list_owners(hosts).c_str());
  std::printf("      fix it: %s\n", kSeparateSystems);
  return false;
}

/** What a system is about to publish must be silent. @return false if it is not. */
bool report_silence(const std::map<std::string, HostReport>& hosts, const ChannelOwners& owners,
                    const std::vector<std::string>& channels) {
  std::string taken;
  for (const std::string& channel : channels) {
    if (owners.is_published(channel)) taken += (taken.empty() ? "" : ", ") + channel;
  }
  if (taken.empty()) return true;
  std::printf("FAIL  another system publishes on %s already: %s\n", taken.c_str(),
              list_owners(hosts).c_str());
  std::printf("      fix it: end it, or %s\n", kSeparateSystems);
  return false;
}

/** Other hosts are reached by one interface. */
void report_reach(const std::string& url, const std::string& interface, bool has_other_host) {
  if (!reaches_other_hosts(url) || has_other_host) return;
  std::printf(
      "note  no program of another host is heard; messages to other hosts leave by %s only. If "
      "they "
      "are in another network: ip route replace 239.255.76.0/24 dev INTERFACE\n",
      interface.c_str());
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
  const BusAddress address = parse_address(url);
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
  if (interface == "lo" && reaches_other_hosts(url) && !check.is_quick) {
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
  ChannelOwners owners;
  const auto hosts = listen_for_hosts(bus, owners);
  if (!report_silence(hosts, owners, check.own_channels)) return 1;
  if (check.is_quick) return 0;
  report_buffer();
  const bool are_clocks_fine = report_hosts(hosts);
  report_reach(url, interface, hosts.size() > hosts.count(own_name()));
  return report_owners(hosts, owners) && are_clocks_fine ? 0 : 1;
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
  bus->on_parsed([&invocation, check] {
    invocation.run = [&invocation, check] {
      return run_bus_check(invocation.common.lcm_url, *check);
    };
  });
}

}  // namespace nao
