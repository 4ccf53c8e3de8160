#pragma once

#include <optional>
#include <string>

#include "messages/command.h"

namespace nao {

/** Where one command stands between its sender and nao-motion, from the sender's side.
 *
 * The bus may lose any message, so the command is repeated: quickly until it is answered, then
 * slowly, which makes nao-motion repeat its latest result. Time is an argument: s of any clock
 * that does not run backwards. */
class CommandExchange {
 public:
  struct Timing {
    /** Between two repetitions while nobody has answered, s. */
    double repeat_period = 0.1;
    /** Between two repetitions after "accepted", s. */
    double confirm_period = 1.0;
    /** Without an answer, or after it without a sign of life, for so long: given up, s. */
    double silence_limit = 3.0;
  };

  /** How the command ended. */
  struct Outcome {
    bool is_success = false;
    /** done, refused, interrupted, failed, unanswered or silent. */
    std::string status;
    /** Why, for a person; may be empty if done. */
    std::string reason;
  };

  CommandExchange(const Timing& timing, double now) : timing_(timing), last_heard_(now) {}

  /** Asks whether to send the command now; answers yes once per period. */
  bool should_send(double now);

  /** A command_result_t for this command came in. */
  void handle_result(ResultStatus status, const std::string& reason, double now);

  /** nao-motion published something else. */
  void handle_sign_of_life(double now);

  bool is_accepted() const { return is_accepted_; }

  /** @return Nothing while the command is under way. */
  std::optional<Outcome> outcome(double now) const;

 private:
  Timing timing_;
  std::optional<double> last_sent_;
  double last_heard_;
  bool is_accepted_ = false;
  std::optional<Outcome> result_;
};

}  // namespace nao
