#include <chrono>
#include <memory>
#include <thread>

#include "common/bus.h"
#include "common/error.h"
#include "tools/nao-tools/log_input.h"

namespace nao {
namespace {

using Clock = std::chrono::steady_clock;

struct PlayOptions {
  std::string file;
  LogPart part;
  double speed = 1;
  bool loops = false;
};

int play(const CommonOptions& common, const PlayOptions& options) {
  Bus bus(common.lcm_url);
  do {
    LogInput log(options.file);
    const Clock::time_point start = Clock::now();
    bool is_empty = true;
    read_part(log, options.part, [&](LogEvent& event, double time) {
      is_empty = false;
      std::this_thread::sleep_until(
          start + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>((time - options.part.from) / options.speed)));
      bus.publish_raw(event.channel, event.data);
    });
    log.warn_about_damage();
    if (is_empty) throw Error(options.file + " contains no message of this part on these channels");
  } while (options.loops);
  return 0;
}

}  // namespace

void add_log_player(CommandLine& log, Invocation& invocation) {
  const auto options = std::make_shared<PlayOptions>();
  // The recorded programs do not run, and commands would move the robot.
  options->part.without = "DAEMON_STATUS|.*_COMMAND";
  CommandLine* command = log.add_subcommand(
      "play", "Publish a log on the bus again; scripts/replay knows the stack's bus");
  command->add_option("file", options->file, "Log of scripts/record")->required();
  command->add_option("--speed", options->speed, "2 is twice as fast")->positive();
  add_part_options(*command, options->part);
  command->add_flag("--loop", options->loops, "Repeat until Ctrl-C");
  invocation.on(*command, [options](const auto& common) { return play(common, *options); });
}

}  // namespace nao
