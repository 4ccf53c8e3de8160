#pragma once

#include <optional>
#include <string>
#include <utility>

#include "messages/command_retry.h"

namespace nao {

/** State of one command of this program: retransmission, and its outcome in words.
 *
 * CommandRetry decides when the command is sent again; this class adds the texts for the user. Time
 * is an argument: s of any monotonic clock. */
class CommandExchange {
 public:
  /** How the command ended. */
  struct Outcome {
    bool is_success = false;
    /** done, refused, interrupted, failed, unanswered or silent. */
    std::string status;
    /** Explanation for the user; may be empty if done. */
    std::string reason;
  };

  /** @param program  That answers, for texts.
   * @param now  Time from which the timeout for the first answer counts. */
  CommandExchange(std::string program, double now)
      : program_(std::move(program)), retry_(kTiming, now) {}

  /** @return true once per period: the command must be sent now. */
  bool should_send(double now) { return retry_.should_send(now); }

  /** Handles a command_result_t of this command. */
  void handle_result(ResultStatus status, const std::string& reason, double now);

  /** Handles any other message of the program. */
  void handle_sign_of_life(double now) { retry_.handle_sign_of_life(now); }

  bool is_accepted() const { return retry_.is_accepted(); }

  /** @return nullopt while the command is in progress. */
  std::optional<Outcome> outcome(double now) const;

 private:
  /** The periods are the protocol's, see README.md. Timeouts, s: chosen: 30 repetitions, so that
   * only a stopped program causes one. */
  static constexpr CommandRetry::Timing kTiming{
      .repeat_period = 0.1, .confirm_period = 1.0, .answer_timeout = 3.0, .silence_timeout = 3.0};

  std::string program_;
  CommandRetry retry_;
  std::optional<Outcome> result_;
};

}  // namespace nao
