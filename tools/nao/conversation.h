#pragma once

#include <cstdint>
#include <limits>
#include <naolcm/walk_command_t.hpp>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/event_loop.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "messages/command_publisher.h"
#include "tools/nao/command_exchange.h"

namespace nao {

class CommandLine;

/** A time that never passes, s. */
inline constexpr double kForever = std::numeric_limits<double>::infinity();

/** Options for waiting for a command's result. */
struct WaitOptions {
  /** Maximum time to wait for the final result, s. */
  double timeout = kForever;
  /** Return at "accepted". */
  bool accepts_only = false;
};

/** Adds --wait and --no-wait. */
void add_wait_options(CommandLine& command, WaitOptions& wait);

/** Sends one command until it is acknowledged, and waits for its end.
 *
 * Ctrl-C ends the waiting only; the robot continues unless the command is a walk. */
class Conversation {
 public:
  /** @param name  The command as given by the user, for messages: "posture Crouch".
   * @param program  That executes it. */
  Conversation(const CommonOptions& common, std::string name,
               const std::string& program = "nao-motion",
               const CommandTiming& timing = CommandExchange::kTiming);

  Bus& bus() { return bus_; }
  const RobotChannels& channels() const { return channels_; }
  const std::string& source() const { return source_; }
  int64_t command_id() const { return command_id_; }
  /** Takes results on a channel beside that of the robot's. */
  void take_results(const std::string& channel);
  /** Takes a result of the command that came in another message. */
  void handle_result(ResultStatus status, const std::string& reason) {
    exchange_.handle_result(status, reason, monotonic_seconds());
  }

  /** Sends a command with a final result until its end. @return The exit status. */
  template <class Command>
  int run_command(const std::string& channel, Command command, const WaitOptions& wait) {
    const double start = monotonic_seconds();
    loop_.every(0.02, [this, &channel, &command, &wait, start] {
      const double now = monotonic_seconds();
      if (exchange_.should_send(now)) commands_.publish(channel, command, source_, command_id_);
      if (exchange_.outcome(now) || (wait.accepts_only && exchange_.is_accepted())) {
        loop_.stop("end");
      } else if (now - start > wait.timeout) {
        loop_.stop("timeout");
      }
    });
    return report(loop_.run(), start);
  }

  /** Sends walk commands for `duration` s or until Ctrl-C, then lets the robot come to a stand.
   * @return The exit status. */
  int run_walk(naolcm::walk_command_t command, double duration);

 private:
  int report(const std::string& why_ended, double start);

  std::string name_;
  std::string source_;
  int64_t command_id_;
  EventLoop loop_;
  Bus bus_;
  RobotChannels channels_;
  CommandPublisher commands_;
  CommandExchange exchange_;
};

}  // namespace nao
