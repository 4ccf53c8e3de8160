#pragma once

#include <cstdint>
#include <string>

#include "common/child_process.h"

namespace nao::bench {

/** Waits until a program prints on which port it listens.
 * @param label  What precedes the port in its output, or the address that ends in ":PORT".
 * @throws std::runtime_error  with the program's output if that takes more than a minute. */
uint16_t wait_for_port(const ChildProcess& program, const std::string& label);

/** Connects to a port of this host. @return The socket, which the caller closes.
 * @throws std::runtime_error  if nothing listens there. */
int connect_to_own_host(uint16_t port);

}  // namespace nao::bench
