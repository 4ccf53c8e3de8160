#include "phone-gateway/server/pairing/own_addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <sstream>

namespace nao::gateway {
namespace {

/** Interfaces may stand on others: a bridge on a bond on hardware. Chosen: nobody stacks more. */
constexpr int kMaxStack = 5;

bool has_hardware(const std::filesystem::path& folder, const std::string& interface, int depth) {
  std::error_code ignored;
  if (std::filesystem::exists(folder / interface / "device", ignored)) return true;
  if (depth == 0) return false;
  constexpr std::string_view kLower = "lower_";
  for (const auto& entry : std::filesystem::directory_iterator(folder / interface, ignored)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(kLower) && has_hardware(folder, name.substr(kLower.size()), depth - 1)) {
      return true;
    }
  }
  return false;
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
    const bool is_point_to_point = (it->ifa_flags & IFF_POINTOPOINT) != 0;
    all.push_back({it->ifa_name, text.data(),
                   interface_kind("/sys/class/net", it->ifa_name, is_point_to_point)});
  }
  freeifaddrs(interfaces);
  return all;
}

}  // namespace

InterfaceKind interface_kind(const std::filesystem::path& folder, const std::string& interface,
                             bool is_point_to_point) {
  if (is_point_to_point) return InterfaceKind::kPointToPoint;
  if (has_hardware(folder, interface, kMaxStack)) return InterfaceKind::kHardware;
  std::error_code ignored;
  const bool is_bridge = std::filesystem::exists(folder / interface / "bridge", ignored);
  return is_bridge ? InterfaceKind::kInnerBridge : InterfaceKind::kVirtual;
}

std::vector<std::string> default_interfaces(std::istream& table) {
  std::multimap<unsigned long, std::string> by_metric;
  std::string line;
  std::getline(table, line);  // titles
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string interface, destination, gateway, flags, references, use, mask;
    unsigned long metric = 0;
    fields >> interface >> destination >> gateway >> flags >> references >> use >> metric >> mask;
    // 0.0.0.0/0 matches every destination.
    if (!fields || destination != "00000000" || mask != "00000000") continue;
    by_metric.emplace(metric, interface);
  }
  std::vector<std::string> interfaces;
  for (const auto& [metric, interface] : by_metric) interfaces.push_back(interface);
  return interfaces;
}

std::vector<std::string> reachable_addresses(const std::vector<InterfaceAddress>& all,
                                             const std::vector<std::string>& default_interfaces) {
  std::vector<InterfaceAddress> kept;
  const auto keep = [&](InterfaceKind kind) {
    for (const InterfaceAddress& address : all) {
      // 169.254/16 is link-local (RFC 3927): no phone on the network reaches it.
      if (address.kind == kind && !address.address.starts_with("169.254.")) kept.push_back(address);
    }
  };
  for (const InterfaceKind kind : {InterfaceKind::kHardware, InterfaceKind::kVirtual}) {
    if (kept.empty()) keep(kind);
  }
  std::stable_sort(kept.begin(), kept.end(), [&](const auto& a, const auto& b) {
    const auto rank = [&](const InterfaceAddress& address) {
      return std::find(default_interfaces.begin(), default_interfaces.end(), address.interface);
    };
    return rank(a) < rank(b);
  });
  keep(InterfaceKind::kPointToPoint);
  if (kept.empty()) keep(InterfaceKind::kInnerBridge);
  std::vector<std::string> addresses;
  for (const InterfaceAddress& address : kept) addresses.push_back(address.address);
  return addresses;
}

std::vector<std::string> own_addresses() {
  std::ifstream routes("/proc/net/route");
  return reachable_addresses(interface_addresses(), default_interfaces(routes));
}

}  // namespace nao::gateway
