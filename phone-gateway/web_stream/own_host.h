#pragma once

#include <istream>
#include <string>
#include <vector>

namespace nao {

/** Name of this host; empty if it has none. */
std::string own_host_name();

/** Names by which browsers may address this host: its name, without its domain too. */
std::vector<std::string> own_host_names();

/** The domains of a resolv.conf, see resolv.conf(5): those of its last "search" or "domain" line,
 * without ".", which is none. */
std::vector<std::string> search_domains(std::istream& resolv_conf);

/** search_domains() of this host, which the network has given it or its owner. */
std::vector<std::string> own_search_domains();

}  // namespace nao
