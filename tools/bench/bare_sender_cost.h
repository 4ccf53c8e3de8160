#pragma once

namespace nao::bench {

/** Messages that a server sends to each client. */
struct SentTraffic {
  /** Small messages and images each second. */
  double state_rate = 0;
  double image_rate = 0;
  /** Mean sizes. */
  double state_bytes = 0;
  double image_bytes = 0;
};

/** Measures nao-bare-sender, a loop that sends as many bytes as often and does nothing else: the
 * baseline of a server.
 * @param time  Duration of the measurement, s.
 * @return Processor time, percent of a core.
 * @throws std::runtime_error  if it does not start, or ends. */
double measure_bare_sender(const SentTraffic& traffic, int num_clients, double time);

}  // namespace nao::bench
