#pragma once

#include <string>
#include <vector>

namespace nao::gateway {

/** Name of this host; empty if it has none. */
std::string own_host_name();

/** IPv4 addresses of this host's interfaces that are up, without loopback. */
std::vector<std::string> own_addresses();

}  // namespace nao::gateway
