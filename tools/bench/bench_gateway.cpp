// Measures what the gateway costs: the latency of a command from a phone to the joints, the age of
// what phones see, and 32 phones at once. Starts simulator, motion, camera and gateway on a bus of
// its own.

#include <unistd.h>

#include "common/scheduling.h"
#include "tools/bench/gateway_latency.h"
#include "tools/bench/gateway_losses.h"
#include "tools/bench/gateway_streams.h"
#include "tools/bench/run_benchmark.h"

namespace nao::bench {
namespace {

std::vector<Figure> run(int num_rounds, double time) {
  const std::string lcm_url =
      "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
  GatewayStack stack(lcm_url);
  std::vector<Figure> figures;
  measure_command_latency(stack, num_rounds, figures);
  measure_streams(stack, time, figures);
  measure_losses(stack, figures);
  return figures;
}

}  // namespace
}  // namespace nao::bench

int main(int argc, char** argv) {
  nao::CommandLine app("Measures the gateway in front of a simulated robot", "nao-bench-gateway");
  int num_rounds = 40;
  double time = 10;
  app.add_option("--rounds", num_rounds, "Commands to time on each path")->range(2, 10000);
  app.add_option("--time", time, "How long clients watch in each measurement, s")
      ->range(2.0, 3600.0);
  return nao::run_benchmark(app, argc, argv, [&] {
    // Phones are machines of their own: what they see must not wait for the processor of this one.
    nao::request_realtime_scheduling(nao::RealtimePriority::kControl);
    return nao::bench::run(num_rounds, time);
  });
}
