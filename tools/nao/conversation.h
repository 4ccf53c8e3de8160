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
               const std::string& program = "nao-motion");

  const RobotChannels& channels() const { return channels_; }

  /** Sends a command with a final result until its end. @return The exit status. */
  template <class Command>
  int run_command(const std::string& channel, Command command, const WaitOptions& wait) {
    const double start = monotonic_seconds();
    loop_.every(0.02, [this, &channel, &command, &wait, start] {
      const double now = monotonic_seconds();
      if (exchange_.should_send(now)) publish(channel, command);
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
  /** Sets the source and publishes the command. */
  template <class Command>
  void publish(const std::string& channel, Command& command) {
    command.utime = 0;
    command.wall_utime = wall_utime();
    command.source = source_;
    command.command_id = command_id_;
    bus_.publish(channel, command);
  }

  int report(const std::string& why_ended, double start);

  std::string name_;
  std::string source_;
  int64_t command_id_;
  EventLoop loop_;
  Bus bus_;
  RobotChannels channels_;
  CommandExchange exchange_;
};

}  // namespace nao
