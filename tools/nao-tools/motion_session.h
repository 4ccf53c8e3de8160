#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/program.h"
#include "messages/command_publisher.h"
#include "tools/nao/command_exchange.h"

namespace nao {

/** Sends nao-motion one command after the other; each waits for the end of the last one. */
class MotionSession {
 public:
  /** What is sent, and what becomes of it. */
  struct Steps {
    /** The next command, if there is one now. */
    std::function<std::optional<decltype(Command::request)>()> next;
    /** It ended. @param fault  Why it was not done; empty: it was. */
    std::function<void(const std::string& fault)> end;
    std::function<bool()> is_done;
  };

  /** @param program  Name, for the commands' source. */
  MotionSession(const CommonOptions& common, const std::string& program);

  EventLoop& loop() { return loop_; }
  Bus& bus() { return bus_; }
  const RobotChannels& channels() const { return channels_; }
  CommandPublisher& commands() { return commands_; }
  const std::string& source() const { return source_; }

  /** Runs until all is done. @return Why it ended before: Ctrl-C, silence, or what fail() said;
   * empty: it did not. */
  std::string execute(Steps steps);
  /** Ends execute(). */
  void fail(const std::string& fault);

 private:
  void step();

  Steps steps_;
  std::string source_;
  EventLoop loop_;
  Bus bus_;
  RobotChannels channels_;
  CommandPublisher commands_;
  Command command_;
  std::optional<CommandExchange> exchange_;
  std::string fault_;
};

}  // namespace nao
