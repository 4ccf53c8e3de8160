#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace nao::gateway {

/** Times of an exhibition's turns, s, and how many may wait. */
struct TurnRules {
  double turn = 90;
  /** The last part of a turn, in which its driver is warned. */
  double warning = 10;
  /** A driver that does nothing for so long loses the turn. */
  double idle = 15;
  /** Between two turns. */
  double changeover = 5;
  /** A visitor whose phone is gone keeps its place for so long. */
  double reconnect = 120;
  size_t max_waiting = 200;
};

/** A person with a phone. */
struct Visitor {
  /** Random text that the phone keeps. */
  std::string key;
  std::string nickname;
  /** The phone is connected; else for how long, s, it has not been. */
  bool is_here = false;
  double absence = 0;
};

/** What has happened since the exhibition's start. */
struct ExhibitionCounts {
  int turns = 0;
  /** Time driven, s. */
  double driven = 0;
  /** Turns that ended before their time. */
  int left = 0;
  int idle = 0;
  int skipped = 0;
  /** Visitors that left, or whose phone did not come back, before their turn. */
  int gone = 0;
  int falls = 0;
  int stops = 0;
  int faults = 0;
};

/** What the operator of an exhibition has set. */
struct OperatorChoices {
  bool forbids_kicks = false;
  bool forbids_falls = false;
  /** Fraction of the robot's highest velocities. */
  double speed = 1;
  /** 0 to 1. */
  double volume = 1;
};

/** Everything that survives a restart of the gateway. Times are durations, s: no clock is in it. */
struct QueueState {
  std::optional<Visitor> driver;
  double turn_left = 0;
  /** Driven in this turn, and when in it the challenge was done; 0: not yet. */
  double turn_time = 0;
  double challenge_time = 0;
  /** Time since the driver's last command. */
  double idle_time = 0;
  double changeover_left = 0;
  std::deque<Visitor> waiting;
  /** Those that have driven, newest last. */
  std::deque<Visitor> served;
  bool is_paused = false;
  bool is_resting = false;
  size_t num_nicknames = 0;
  /** Best time of the challenge, s, and whose it is; 0: none. */
  double best_time = 0;
  std::string best_nickname;
  OperatorChoices choices;
  ExhibitionCounts counts;
};

/** What one visitor is told. */
struct VisitorView {
  enum class Phase { kNone, kWaiting, kDriving, kServed };
  Phase phase = Phase::kNone;
  std::string nickname;
  /** 1: the next. */
  size_t place = 0;
  /** Until its turn begins, s, if nobody leaves and nothing pauses. */
  double wait = 0;
};

/** The visitors of an exhibition: who waits, who drives, for how long. One phone, known by its key,
 * has one place. Without clock, bus or thread. */
class VisitorQueue {
 public:
  VisitorQueue(TurnRules rules, std::vector<std::string> nicknames, QueueState state = {});

  /** A phone is there. A new one gets a place at the end; a known one keeps what it has.
   * @param again  One that has driven gets a place at the end, too.
   * @return false if the queue is full. */
  bool attend(const std::string& key, bool again);
  /** The visitor leaves queue or turn. */
  void leave(const std::string& key);
  /** The phone's connection has ended. */
  void lose(const std::string& key);
  /** The driver has sent a command. */
  void note_command() { state_.idle_time = 0; }

  /** Time passes: turns begin and end. @param dt  s, not negative. */
  void step(double dt);

  // Requests of the operator.

  /** The clock of the turn stands, and nobody drives. */
  void set_paused(bool is_paused) { state_.is_paused = is_paused; }
  /** The turn ends, and none begins until the rest ends. A driver that had less than half of its
   * turn is the next one. */
  void set_resting(bool is_resting);
  void skip();
  /** Prolongs the turn. @param time  s. */
  void extend(double time);

  bool is_halted() const { return state_.is_paused || state_.is_resting; }
  /** The visitor that may drive now; nullptr: nobody. */
  const Visitor* driver() const {
    return state_.driver && !is_halted() ? &*state_.driver : nullptr;
  }
  bool is_warned() const { return state_.driver && state_.turn_left <= rules_.warning; }
  /** Whether a visitor drives, or waits with a phone that is connected. */
  bool has_visitors() const;
  VisitorView view(const std::string& key) const;

  const TurnRules& rules() const { return rules_; }
  const QueueState& state() const { return state_; }
  ExhibitionCounts& counts() { return state_.counts; }
  OperatorChoices& choices() { return state_.choices; }
  /** The driver has done the challenge; the first time in a turn counts. */
  void note_challenge();

 private:
  enum class End { kTime, kLeft, kIdle, kSkipped, kRest };
  void begin_turn(std::deque<Visitor>::iterator next);
  void end_turn(End end);
  std::string next_nickname();
  std::deque<Visitor>::iterator find_waiting(const std::string& key);

  TurnRules rules_;
  std::vector<std::string> nicknames_;
  QueueState state_;
};

}  // namespace nao::gateway
