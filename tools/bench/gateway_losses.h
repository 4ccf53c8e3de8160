#pragma once

#include <vector>

#include "tools/bench/figures.h"
#include "tools/bench/gateway_stack.h"

namespace nao::bench {

/** Stops each program for a while, and measures how long it takes until a client is notified that
 * the component is unavailable, and that it is available again. */
void measure_losses(GatewayStack& stack, std::vector<Figure>& figures);

}  // namespace nao::bench
