#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/status_reporter.h"
#include "common/wall_clock.h"
#include "tools/nao-tools/channel_pattern.h"
#include "tools/nao-tools/log_writer.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/tools_subcommands.h"

namespace nao {
namespace {

// Maximum duration of the recording that a killed recorder loses, s.
constexpr double kFlushPeriod = 0.1;
// As of every program, see daemon_status_t, s.
constexpr double kStatusPeriod = 1.0;
// LCM's default queue holds 30 messages, about 60 ms of this bus; later ones are dropped. This
// queue holds minutes.
constexpr int kQueueCapacity = 100'000;
// Requested size of the socket's buffer, bytes; the kernel limits it to net.core.rmem_max.
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

/** Writes every selected message to the log. */
struct Recorder {
  LogWriter writer;
  std::optional<ChannelPattern> without;
  /** Why messages are not written; empty if they are. */
  std::string fault;

  void flush() {
    const std::string before = std::exchange(fault, "");
    try {
      writer.flush();
    } catch (const Error& error) {
      fault = error.what();
    }
    if (before.empty() && !fault.empty()) logger::error("{}; trying again", fault);
    if (!before.empty() && fault.empty()) logger::info("the recording goes on");
  }

  void receive(const RawMessage& message) {
    if (without && without->matches(message.channel)) return;
    // flush() meets the same error and reports it.
    try {
      writer.write(
          {0, message.wall_utime, message.channel, {message.bytes.begin(), message.bytes.end()}});
    } catch (const Error&) {
    }
  }
};

int run_record(const CommonOptions& common, const RecordOptions& options) {
  EventLoop loop;
  Bus bus(with_receive_buffer(common.lcm_url));
  std::optional<ChannelPattern> without;
  if (!options.without.empty()) without.emplace("--without", options.without);
  Recorder recorder{
      LogWriter(options.file, {static_cast<int64_t>(options.split_mb * 1e6), options.num_kept}),
      std::move(without),
      {}};
  StatusReporter status(bus, "nao-record");
  bus.subscribe_raw(
      options.channels, [&](const RawMessage& message) { recorder.receive(message); },
      kQueueCapacity);
  loop.on_readable(bus.descriptor(), [&bus] { bus.handle(); });
  const double end = monotonic_seconds() + options.duration;
  loop.every(kFlushPeriod, [&] {
    recorder.flush();
    if (monotonic_seconds() >= end) loop.stop("end");
  });
  loop.every_aligned(kStatusPeriod, [&] {
    const LogWriter& writer = recorder.writer;
    status.set_state(recorder.fault.empty() ? "ready" : "waiting",
                     recorder.fault.empty() ? "recording " + options.file : recorder.fault);
    status.publish({{"messages", static_cast<double>(writer.num_events())},
                    {"messages_lost", static_cast<double>(writer.num_lost())}});
  });
  loop.run();
  recorder.writer.flush();
  std::fprintf(stderr, "%ld messages recorded\n", static_cast<long>(recorder.writer.num_events()));
  if (recorder.writer.num_lost() > 0) {
    std::fprintf(stderr, "%ld messages lost while they could not be written\n",
                 static_cast<long>(recorder.writer.num_lost()));
  }
  return 0;
}

}  // namespace

void add_record_command(CommandLine& app, Invocation& invocation) {
  const auto options = std::make_shared<RecordOptions>();
  CommandLine* record = app.add_subcommand(kRecordSubcommand.name, kRecordSubcommand.help);
  record->add_option("file", options->file, "Log to write; must not exist")->required();
  record->add_option("--channels", options->channels,
                     "Only channels whose whole name matches this regular expression");
  record->add_option("--without", options->without, "Exclude channels that match this one");
  record->add_option("--for", options->duration, "Duration of the recording, s")->positive();
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
  invocation.on(*record, [options](const auto& common) { return run_record(common, *options); });
}

}  // namespace nao
