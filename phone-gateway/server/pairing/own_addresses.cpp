#include "phone-gateway/server/pairing/own_addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <sstream>

namespace nao::gateway {
namespace {

bool begins_with(const std::string& text, const char* beginning) {
  return text.rfind(beginning, 0) == 0;
}

/** Interfaces of Docker ("docker0", "br-..."), of containers ("veth...") and of libvirt
 * ("virbr0"). */
bool is_within_host(const std::string& interface) {
  return begins_with(interface, "docker") || begins_with(interface, "br-") ||
         begins_with(interface, "veth") || begins_with(interface, "virbr");
}

std::vector<InterfaceAddress> interface_addresses() {
  std::vector<InterfaceAddress> all;
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) != 0) return all;
  for (const ifaddrs* it = interfaces; it != nullptr; it = it->ifa_next) {
    // IPv4 only: addresses that people can type.
    if (it->ifa_addr == nullptr || it->ifa_addr->sa_family != AF_INET) continue;
    if ((it->ifa_flags & IFF_LOOPBACK) != 0 || (it->ifa_flags & IFF_UP) == 0) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(it->ifa_addr);
    inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
    all.push_back({it->ifa_name, text.data()});
  }
  freeifaddrs(interfaces);
  return all;
}

}  // namespace

// `table` has the form of /proc/net/route; the default route with the smallest metric wins.
std::string default_interface(std::istream& table) {
  std::string best;
  unsigned long best_metric = std::numeric_limits<unsigned long>::max();
  std::string line;
  std::getline(table, line);  // titles
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string interface, destination, gateway, flags, references, use, mask;
    unsigned long metric = 0;
    fields >> interface >> destination >> gateway >> flags >> references >> use >> metric >> mask;
    // 0.0.0.0/0 matches every destination.
    if (!fields || destination != "00000000" || mask != "00000000") continue;
    if (metric < best_metric) {
      best = interface;
      best_metric = metric;
    }
  }
  return best;
}

std::vector<std::string> reachable_addresses(const std::vector<InterfaceAddress>& all,
                                             const std::string& first) {
  std::vector<InterfaceAddress> kept;
  for (const InterfaceAddress& address : all) {
    // 169.254/16 is link-local (RFC 3927): no phone on the network reaches it.
    if (!is_within_host(address.interface) && !begins_with(address.address, "169.254.")) {
      kept.push_back(address);
    }
  }
  // The default interface first: its address is the one in the QR code.
  std::stable_partition(kept.begin(), kept.end(), [&](const InterfaceAddress& address) {
    return address.interface == first;
  });
  std::vector<std::string> addresses;
  for (const InterfaceAddress& address : kept) addresses.push_back(address.address);
  return addresses;
}

std::vector<std::string> own_addresses() {
  std::ifstream routes("/proc/net/route");
  return reachable_addresses(interface_addresses(), default_interface(routes));
}

}  // namespace nao::gateway
