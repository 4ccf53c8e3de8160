#pragma once

#include <optional>
#include <string>
#include <utility>

#include "messages/command_sender.h"

namespace nao {

/** State of one command of this program: retransmission, and its outcome in words. Time is an
 * argument: s of any monotonic clock. */
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

  /** Time from the last message of a program until it counts as ended, s. */
  static constexpr double kSilenceTimeout = 3.0;
  /** Timing of a command with a result, which is confirmed once a second. */
  static constexpr CommandTiming kTiming{.confirm_period = 1.0, .silence_timeout = kSilenceTimeout};
  /** Timing of a walk, which is repeated as long as it lasts. */
  static constexpr CommandTiming kWalkTiming{.confirm_period = kRepeatPeriod,
                                             .silence_timeout = kSilenceTimeout};

  /** @param program  That answers, for texts.
   * @param now  Time from which the timeout for the first answer counts. */
  CommandExchange(std::string program, double now, const CommandTiming& timing = kTiming)
      : program_(std::move(program)) {
    sender_.send({}, now, {}, timing);
  }

  /** @return true once per period: the command must be sent now. */
  bool should_send(double now) { return !sender_.take_due(now).empty(); }

  /** Handles a result of this command. */
  void handle_result(ResultStatus status, const std::string& reason, double now);

  /** Handles any other message of the program. */
  void handle_sign_of_life(double now) { sender_.handle_sign_of_life(now); }

  bool is_accepted() const { return is_accepted_; }

  /** @return nullopt while the command is in progress. */
  std::optional<Outcome> outcome(double now);

 private:
  /** The caller has the command itself. */
  struct Key {
    std::string source;
    int64_t id = 0;
  };

  std::string program_;
  CommandSender<Key> sender_;
  bool is_accepted_ = false;
  std::optional<Outcome> result_;
};

}  // namespace nao
