#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace nao::gateway {

/** What is behind an interface of this host. */
enum class InterfaceKind {
  /** Hardware, by itself or through a bridge, a bond or a VLAN. */
  kHardware,
  /** Nothing but software, as a container's own interface. */
  kVirtual,
  /** A bridge of containers or virtual machines, whose network is within this host. */
  kInnerBridge,
  /** One other host, as of a VPN. */
  kPointToPoint
};

/** An IPv4 address of one of this host's interfaces. */
struct InterfaceAddress {
  std::string interface;
  std::string address;
  InterfaceKind kind = InterfaceKind::kHardware;
};

/** @param folder  /sys/class/net, see sysfs(5): a folder for each interface, with "device" for
 *   hardware, "bridge" for a bridge, and "lower_NAME" for each interface below it. */
InterfaceKind interface_kind(const std::filesystem::path& folder, const std::string& interface,
                             bool is_point_to_point);

/** Interfaces of the default routes, that with the smallest metric first, as the kernel chooses.
 * @param table  /proc/net/route, see proc(5): a line of titles, then interface, destination,
 * gateway, flags, references, use, metric ... of each route, addresses in hexadecimal. */
std::vector<std::string> default_interfaces(std::istream& table);

/** The addresses at which other hosts may reach this one, without link-local addresses (RFC 3927).
 * Hardware comes first, in the order of `default_interfaces`: the first address is the one in the
 * QR code. VPNs come last, since phones in the same network are in none. What is within this host
 * is left out, unless the host has nothing else, as a container. */
std::vector<std::string> reachable_addresses(const std::vector<InterfaceAddress>& all,
                                             const std::vector<std::string>& default_interfaces);

/** reachable_addresses() of the interfaces that are up, without loopback. */
std::vector<std::string> own_addresses();

}  // namespace nao::gateway
