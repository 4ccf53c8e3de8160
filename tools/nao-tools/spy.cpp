#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/wall_clock.h"
#include "tools/nao-tools/channel_statistics.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/terminal.h"
#include "tools/nao/tools_subcommands.h"

namespace nao {
namespace {

/** Averaging period of the rates, s. */
constexpr double kPeriod = 1.0;

int run_spy(const CommonOptions& common, double duration, bool as_json) {
  EventLoop loop;
  Bus bus(common.lcm_url);
  ChannelStatistics statistics;
  bus.subscribe_raw(
      ".*",
      [&statistics](const RawMessage& message) {
        statistics.add(message.channel, message.bytes.data(),
                       static_cast<int>(message.bytes.size()), monotonic_seconds());
      },
      0);
  loop.on_readable(bus.descriptor(), [&bus] { bus.handle(); });
  const double start = monotonic_seconds();
  loop.every(kPeriod, [&] {
    const double now = monotonic_seconds();
    statistics.finish_period(now);
    const bool is_last = now - start >= duration;
    if (is_last) loop.stop("end");
    if (std::isfinite(duration) && !is_last) return;
    clear_terminal();
    std::fputs(as_json ? (statistics.to_json(now) + "\n").c_str() : statistics.to_text(now).c_str(),
               stdout);
    if (!as_json) {
      std::printf("%zu channels, %ld undecodable messages\n\n", statistics.channels().size(),
                  static_cast<long>(statistics.num_undecodable()));
    }
    std::fflush(stdout);
  });
  loop.run();
  return 0;
}

}  // namespace

void add_spy_command(CommandLine& app, Invocation& invocation) {
  auto duration = std::make_shared<double>(std::numeric_limits<double>::infinity());
  auto as_json = std::make_shared<bool>(false);
  CommandLine* spy = app.add_subcommand(kSpySubcommand.name, kSpySubcommand.help);
  spy->add_option("--for", *duration, "Listening time before printing once and ending, s")
      ->positive();
  spy->add_flag("--json", *as_json, "As JSON, one line each time");
  invocation.on(*spy, [duration, as_json](const auto& common) {
    return run_spy(common, *duration, *as_json);
  });
}

}  // namespace nao
