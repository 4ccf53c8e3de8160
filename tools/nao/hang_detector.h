#pragma once

#include <map>
#include <string>
#include <vector>

namespace nao {

/** Finds programs that still exist but have stopped speaking: hung, or stopped by a signal.
 *
 * Silence proves a hang only while the listener itself hears well. So it counts time only while the
 * listener's own heartbeat comes back over the bus and its own turns come on time: a broken bus, a
 * machine that is overloaded or was asleep, accuse nobody. Time is an argument, s of any clock. */
class HangDetector {
 public:
  struct Limits {
    /** Silence that means a hang, s; every program speaks once a second. */
    double silence = 4.0;
    /** Longest time between two turns of a listener that is on time, s. */
    double late_turn = 1.0;
    /** Longest time between two own heartbeats heard, s. */
    double own_silence = 2.5;
  };

  /** One program that is to be ended. */
  struct Hung {
    int process_id = 0;
    std::string program;
    /** For how long it has said nothing, s. */
    double silence = 0;
  };

  explicit HangDetector(const Limits& limits) : limits_(limits) {}

  /** A program spoke. */
  void handle_status(int process_id, const std::string& program);

  /** The listener's own heartbeat came back. */
  void handle_own_heartbeat(double now) { last_own_heartbeat_ = now; }

  /** A process ended; it is no longer waited for. */
  void forget(int process_id) { programs_.erase(process_id); }

  /** Processes that have spoken and were not forgotten. */
  std::vector<int> process_ids() const;

  /** One turn of the listener, several times a second.
   * @return Who hangs; each is named once and then forgotten. */
  std::vector<Hung> step(double now);

 private:
  struct Program {
    std::string name;
    double silence = 0;
  };

  Limits limits_;
  std::map<int, Program> programs_;
  double last_turn_ = -1;
  double last_own_heartbeat_ = -1e9;
};

}  // namespace nao
