#pragma once

#include <string>
#include <vector>

namespace nao {

/** This host's name, and the IPv4 addresses that others may reach it by (loopback left out). */
std::string own_host_name();
std::vector<std::string> own_addresses();

}  // namespace nao
