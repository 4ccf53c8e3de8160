#pragma once

#include <istream>
#include <string>
#include <vector>

namespace nao::gateway {

/** An IPv4 address of one of this host's interfaces. */
struct InterfaceAddress {
  std::string interface;
  std::string address;
};

/** Interface of the default route; empty if there is none. Of several the one with the smallest
 * metric, as the kernel chooses.
 * @param table  /proc/net/route, see proc(5): a line of titles, then interface, destination,
 * gateway, flags, references, use, metric ... of each route, addresses in hexadecimal. */
std::string default_interface(std::istream& table);

/** The addresses at which other hosts may reach this one: without link-local addresses (RFC 3927)
 * and without the bridges of containers and virtual machines, whose networks are within this host.
 * @param first  The addresses of this interface come first. */
std::vector<std::string> reachable_addresses(const std::vector<InterfaceAddress>& all,
                                             const std::string& first);

/** reachable_addresses() of the interfaces that are up, without loopback; those of the default
 * route first. */
std::vector<std::string> own_addresses();

}  // namespace nao::gateway
