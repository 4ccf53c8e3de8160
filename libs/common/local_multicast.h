#pragma once

#include <string>

namespace nao {

/** Whether messages of an LCM URL stay on this host: a multicast bus whose time to live is 0, LCM's
 * default. */
bool is_local_bus(const std::string& lcm_url);

/** From now on this process sends multicast messages by the loopback interface, whatever the routes
 * are, and also receives those that other programs send there. For a bus with the time to live 0:
 * LCM lets the kernel choose the interface by the routes, so that the programs of one host would no
 * longer hear one another where a network comes or goes.
 *
 * LCM has no option for it. This library therefore defines connect() and setsockopt(), which LCM
 * calls, and passes all calls on to those of the C library. */
void keep_multicast_local();

}  // namespace nao
