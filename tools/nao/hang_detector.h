#pragma once

#include <map>
#include <string>
#include <vector>

namespace nao {

/** Detects programs that still exist but have stopped publishing, or never began to: hung, or
 * stopped by a signal.
 *
 * A missing status proves a hang only while the detector receives messages. Time therefore counts
 * only while the detector's own heartbeat returns over the bus and step() is called on time: a
 * broken bus, an overloaded machine or a suspended one causes no false detection. Time is an
 * argument: s of any monotonic clock. */
class HangDetector {
 public:
  struct Limits {
    /** Time without a status that means a hang, s; every program publishes once a second. */
    double silence = 4.0;
    /** The same before the first status, s. Chosen: as long as scripts/start waits for programs. */
    double first_silence = 60.0;
    /** Maximum time between two calls of step() that counts as on time, s. */
    double max_step_period = 1.0;
    /** Maximum time between two received own heartbeats, s. */
    double max_own_silence = 2.5;
  };

  /** A program that hangs. */
  struct Hung {
    int process_id = 0;
    std::string program;
    /** Counted time without a status, s. */
    double silence = 0;
  };

  explicit HangDetector(const Limits& limits) : limits_(limits) {}

  /** A process exists; it is monitored from now on, also if it never publishes. */
  void handle_process(int process_id, const std::string& program);

  /** A program published its status. */
  void handle_status(int process_id, const std::string& program);

  /** The detector's own heartbeat was received. */
  void handle_own_heartbeat(double now) { last_own_heartbeat_ = now; }

  /** A process has ended and is no longer monitored. */
  void forget(int process_id) { programs_.erase(process_id); }

  /** Monitored processes. */
  std::vector<int> process_ids() const;

  /** Number of monitored processes that have published. */
  int num_published() const;

  /** Advances to time `now`; call it several times a second. @return The programs that hang; each
   * is returned once and then forgotten. */
  std::vector<Hung> step(double now);

 private:
  struct Program {
    std::string name;
    double silence = 0;
    bool has_published = false;
  };

  Limits limits_;
  std::map<int, Program> programs_;
  double last_step_ = -1;
  double last_own_heartbeat_ = -1e9;
};

}  // namespace nao
