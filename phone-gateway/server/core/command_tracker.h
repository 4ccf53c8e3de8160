#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "messages/command.h"
#include "messages/command_retry.h"
#include "phone-gateway/server/core/gateway_limits.h"

namespace nao::gateway {

/** The commands whose final result has not arrived: repeats each until nao-motion answers, and
 * stores which client sent it. */
class CommandTracker {
 public:
  /** A command and the client that sent it; client 0 is the gateway itself. */
  struct Entry {
    uint32_t client = 0;
    uint32_t request_id = 0;
    Command command;
    CommandRetry retry;
  };

  explicit CommandTracker(const GatewayLimits& limits) : limits_(limits) {}

  /** Stores a command that is being sent now. A walk is not repeated here, and does not time out:
   * WalkStream repeats it. Of more than 256 commands the oldest is dropped. */
  void add(uint32_t client, uint32_t request_id, const Command& command, double now);

  /** Removes the unanswered commands that a newer command of kind `newer` replaces: if they were
   * still repeated, an older command could arrive last. Joint changes add up and do not replace one
   * another. */
  std::vector<Entry> supersede(CommandKind newer);

  /** Handles a result. @return The command's entry; nothing if the command is unknown or the result
   *   a repetition. */
  std::optional<Entry> handle_result(const std::string& source, int64_t id, ResultStatus status,
                                     double now);

  /** Forgets the sender of a client's commands: it has disconnected.
   * @return true if one of them is a MoveTo, whose walk goes on. */
  bool forget_client(uint32_t client);

  /** Commands to be sent again now. */
  std::vector<Command> take_due(double now);

  /** Removes the commands that nao-motion has not answered in time. */
  std::vector<Entry> take_timed_out(double now);

  /** Removes every command. */
  std::vector<Entry> take_all();

  size_t size() const { return entries_.size(); }

 private:
  GatewayLimits limits_;
  std::deque<Entry> entries_;
};

}  // namespace nao::gateway
