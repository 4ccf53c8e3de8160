#pragma once

#include <limits>
#include <optional>

#include "messages/command.h"

namespace nao {

/** Decides when one command is transmitted again, from the sender's side.
 *
 * The bus may lose any message. Therefore a command is repeated until its receiver answers; the
 * receiver executes it once. After STATUS_ACCEPTED it may be repeated at a lower rate: each
 * repetition makes the receiver send its latest result again, in case that one was lost.
 *
 * Time is an argument: seconds of any clock that never runs backwards. */
class CommandRetry {
 public:
  /** A period or timeout that never passes. */
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /** Periods and timeouts, s. */
  struct Timing {
    /** Between two transmissions while the command is unanswered. */
    double repeat_period = 0.1;
    /** Between two transmissions of an accepted command. */
    double confirm_period = kNever;
    /** From the construction until an unanswered command has timed out. */
    double answer_timeout = 1.5;
    /** From the receiver's last message until an accepted command has timed out. */
    double silence_timeout = kNever;
  };

  /** @param now  Time from which the answer timeout counts. */
  CommandRetry(const Timing& timing, double now) : timing_(timing), last_heard_(now) {}

  /** @return true if the command must be transmitted now: at the first call, and then once in each
   *   period until the command has ended. */
  [[nodiscard]] bool should_send(double now);

  /** A result of this command arrived.
   * @return true if it is news: the first acceptance or the first final result. Repetitions, and
   *   results after the final one, are not. */
  bool handle_result(ResultStatus status, double now);

  /** Any other message of the receiver arrived: an accepted command has not timed out. */
  void handle_sign_of_life(double now);

  /** True from STATUS_ACCEPTED on, also after the end. */
  bool is_accepted() const { return is_accepted_; }

  /** True once a final result has arrived. */
  bool has_ended() const { return has_ended_; }

  /** True if the receiver has not answered in time, or has fallen silent before the command ended.
   */
  bool has_timed_out(double now) const;

 private:
  Timing timing_;
  std::optional<double> last_sent_;
  double last_heard_;
  bool is_accepted_ = false;
  bool has_ended_ = false;
};

}  // namespace nao
