#include <cmath>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <memory>
#include <string>

#include "common/command_line.h"
#include "common/error.h"
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

/** Adds every message on the bus, of any type, to the statistics. */
struct Listener {
  ChannelStatistics statistics;

  void receive(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    // LCM's own self-test message, sent whenever a program opens the bus.
    if (channel == "LCM_SELF_TEST") return;
    statistics.add(channel, buffer->data, static_cast<int>(buffer->data_size), monotonic_seconds());
  }
};

int run_spy(const CommonOptions& common, double duration, bool as_json) {
  EventLoop loop;
  // nao::Bus decodes one known type per channel; this program receives all types.
  lcm::LCM lcm(common.lcm_url);
  if (!lcm.good())
    throw BusError("cannot open the message bus " + common.lcm_url + "; try: nao bus");
  Listener listener;
  lcm.subscribe(".*", &Listener::receive, &listener)->setQueueCapacity(0);
  loop.on_readable(lcm.getFileno(), [&lcm] {
    while (lcm.handleTimeout(0) > 0) {
    }
  });
  const double start = monotonic_seconds();
  loop.every(kPeriod, [&] {
    const double now = monotonic_seconds();
    listener.statistics.finish_period(now);
    const bool is_last = now - start >= duration;
    if (is_last) loop.stop("end");
    if (std::isfinite(duration) && !is_last) return;
    clear_terminal();
    std::fputs(as_json ? (listener.statistics.to_json(now) + "\n").c_str()
                       : listener.statistics.to_text(now).c_str(),
               stdout);
    if (!as_json) {
      std::printf("%zu channels, %ld undecodable messages\n\n",
                  listener.statistics.channels().size(),
                  static_cast<long>(listener.statistics.num_undecodable()));
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
  spy->on_parsed([&invocation, duration, as_json] {
    invocation.run = [&invocation, duration, as_json] {
      return run_spy(invocation.common, *duration, *as_json);
    };
  });
}

}  // namespace nao
