#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <regex>
#include <string>

#include "common/command_line.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/wall_clock.h"
#include "tools/nao/log_writer.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

// What a recorder that is killed may lose, s.
constexpr double kFlushPeriod = 0.1;
// LCM keeps 30 messages for a subscriber that is late, and drops the rest: 60 ms of this bus. These
// are minutes.
constexpr int kQueueCapacity = 100'000;
// Wished for in the kernel; it gives at most net.core.rmem_max.
constexpr const char* kReceiveBuffer = "recv_buf_size=8388608";

struct RecordOptions {
  std::string file;
  std::string channels = ".*";
  std::string without;
  double duration = std::numeric_limits<double>::infinity();
  double split_mb = 0;
  int num_kept = 0;
};

std::string with_receive_buffer(const std::string& url) {
  if (!url.starts_with("udpm://") || url.find("recv_buf_size") != std::string::npos) return url;
  return url + (url.find('?') == std::string::npos ? "?" : "&") + kReceiveBuffer;
}

/** Puts every wanted message into the log. */
struct Recorder {
  LogWriter writer;
  std::optional<std::regex> without;
  /** Why it cannot write; no exception may pass through LCM's C code. */
  std::string fault;

  void receive(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    // LCM sends this to itself whenever a program opens the bus; it is nobody's message.
    if (channel == "LCM_SELF_TEST") return;
    if (without && std::regex_match(channel, *without)) return;
    const auto* data = static_cast<const uint8_t*>(buffer->data);
    try {
      writer.write({0, buffer->recv_utime, channel, {data, data + buffer->data_size}});
    } catch (const Error& error) {
      fault = error.what();
    }
  }
};

int run_record(const CommonOptions& common, const RecordOptions& options) {
  EventLoop loop;
  // Not a nao::Bus, as in spy.cpp.
  lcm::LCM lcm(with_receive_buffer(common.lcm_url));
  if (!lcm.good()) {
    throw BusError("cannot open the message bus " + common.lcm_url + "; try: nao bus");
  }
  std::optional<std::regex> without;
  if (!options.without.empty()) without.emplace(options.without, std::regex::extended);
  Recorder recorder{
      LogWriter(options.file, {static_cast<int64_t>(options.split_mb * 1e6), options.num_kept}),
      std::move(without),
      {}};
  lcm::Subscription* subscription = lcm.subscribe(options.channels, &Recorder::receive, &recorder);
  subscription->setQueueCapacity(kQueueCapacity);
  loop.on_readable(lcm.getFileno(), [&lcm] {
    while (lcm.handleTimeout(0) > 0) {
    }
  });
  const double end = monotonic_seconds() + options.duration;
  loop.every(kFlushPeriod, [&] {
    recorder.writer.flush();
    if (!recorder.fault.empty()) throw Error(recorder.fault);
    if (monotonic_seconds() >= end) loop.stop("end");
  });
  loop.run();
  lcm.unsubscribe(subscription);
  recorder.writer.flush();
  std::fprintf(stderr, "%ld messages recorded\n", static_cast<long>(recorder.writer.num_events()));
  return 0;
}

}  // namespace

void add_record_command(CommandLine& app, Invocation& invocation) {
  const auto options = std::make_shared<RecordOptions>();
  CommandLine* record = app.add_subcommand(
      "record", "Record messages into a log until Ctrl-C; scripts/record knows the stack's bus");
  record->add_option("file", options->file, "Log to write; must not be there yet")->required();
  record
      ->add_option("--channels", options->channels,
                   "Only channels whose whole name matches this regular expression")
      ->show_default();
  record->add_option("--without", options->without, "But not those that match this one");
  record->add_option("--for", options->duration, "End by itself, s")->positive();
  CommandLine::Option* split =
      record
          ->add_option("--split-mb", options->split_mb,
                       "Begin a new file, FILE.00, FILE.01 ..., at this size")
          ->positive();
  record
      ->add_option("--rotate", options->num_kept,
                   "Keep only this many files, FILE.0 being the newest")
      ->positive()
      ->needs(split);
  record->on_parsed([&invocation, options] {
    invocation.run = [&invocation, options] { return run_record(invocation.common, *options); };
  });
}

}  // namespace nao
