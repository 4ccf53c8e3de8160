#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "phone-gateway/server/gateway_limits.h"
#include "phone-gateway/server/motion_command.h"

namespace nao {

/** What nao-motion says about a command. */
enum class CommandStatus { kAccepted, kRefused, kDone, kInterrupted, kFailed };

/** The commands that have been sent and whose end is not yet known: repeats each until nao-motion
 * answers, and remembers who asked for it. */
class CommandTracker {
 public:
  /** A command and who asked: client 0 is the gateway itself. */
  struct Entry {
    uint32_t client = 0;
    uint32_t request_id = 0;
    NumberedCommand command;
    /** False for walks, which repeat in their own way. */
    bool repeats = true;
    bool is_answered = false;
    double first_sent = 0;
    double next_repeat = 0;
  };

  explicit CommandTracker(const GatewayLimits& limits) : limits_(limits) {}

  /** Remembers a command that is being sent now. The oldest of more than 256 is forgotten. */
  void add(uint32_t client, uint32_t request_id, const NumberedCommand& command, double now);

  /** Takes out the commands that nao-motion has not answered yet and that a newer command of this
   * kind makes void: were they still repeated, the older one could win. Joint changes add up, so
   * one leaves another alone. */
  std::vector<Entry> supersede(const MotionCommand& newer);

  /** Takes note of a result. @return Whose command it was, unless it is unknown, or known already.
   */
  std::optional<Entry> answer(const std::string& source, int64_t command_id, CommandStatus status);

  /** Forgets whom to tell about the commands of a client that went away.
   * @return true if it left the robot walking to a place. */
  bool forget_client(uint32_t client);

  /** Commands to be sent again now. */
  std::vector<NumberedCommand> due(double now);

  /** Takes out the commands that nao-motion has not answered in time. */
  std::vector<Entry> take_unanswered(double now);

  /** Takes out every command: nao-motion has gone away. */
  std::vector<Entry> take_all();

  size_t size() const { return entries_.size(); }

 private:
  GatewayLimits limits_;
  std::deque<Entry> entries_;
};

}  // namespace nao
