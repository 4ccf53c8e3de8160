#pragma once

#include <vector>

#include "tools/bench/figures.h"
#include "tools/bench/gateway_stack.h"

namespace nao::bench {

/** Measures the latency of a change of a joint's angle, from the request to the measured motion:
 * over raw TCP, over WebSocket, and directly on the bus without a gateway.
 * @param num_rounds  Number of commands on each of the three. */
void measure_command_latency(GatewayStack& stack, int num_rounds, std::vector<Figure>& figures);

}  // namespace nao::bench
