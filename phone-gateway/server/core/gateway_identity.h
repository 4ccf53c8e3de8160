#pragma once

#include <cstdint>
#include <string>

namespace nao::gateway {

/** Identity of the gateway towards clients and on the bus. */
struct GatewayIdentity {
  std::string server_version;
  /** Pairing token that clients of other hosts send in Connect. */
  std::string token;
  /** Prefix of the sources of its commands, unique on the bus: "phone.4711". */
  std::string source;
  /** Number of its first command. Greater than those of every earlier run, since nao-motion
   * executes each number only once. */
  int64_t first_command_id = 1;
};

}  // namespace nao::gateway
