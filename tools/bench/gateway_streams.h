#pragma once

#include <vector>

#include "tools/bench/figures.h"
#include "tools/bench/gateway_stack.h"

namespace nao::bench {

/** Measures the age of the states and images that clients see, and the processor time of the
 * gateway: with one client, with 32, and with 29 together with three that misbehave. The baseline
 * of the processor time is a loop that sends as many bytes as often.
 * @param time  Duration of each measurement, s. */
void measure_streams(GatewayStack& stack, double time, std::vector<Figure>& figures);

}  // namespace nao::bench
