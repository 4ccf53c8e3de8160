#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "common/command_line.h"
#include "common/error.h"
#include "common/json_writer.h"
#include "common/log_reader.h"
#include "common/output_file.h"
#include "common/program.h"
#include "tools/nao-tools/channel_pattern.h"
#include "tools/nao-tools/log_input.h"
#include "tools/nao-tools/log_statistics.h"
#include "tools/nao-tools/message_table.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/tools_subcommands.h"

namespace nao {
namespace {

struct LogOptions {
  std::string file;
  std::string output;
  std::string channel;
  std::string channels = ".*";
  bool as_json = false;
  LogPart part;
  std::string model = "nao";
  /** Robot that the options of all subcommands name. */
  std::string robot;
};

/** Standard output, or a file if one is named. */
class Output {
 public:
  explicit Output(const std::string& file) {
    if (!file.empty()) file_.emplace(file);
  }
  std::ostream& stream() { return file_ ? file_->stream() : std::cout; }
  void finish() {
    if (file_) return file_->finish();
    if (!std::cout.flush()) throw Error("cannot write all of stdout");
  }

 private:
  std::optional<OutputFile> file_;
};

/** @throws ConfigError  if the output is the log itself, also by a link: opening it would empty it.
 */
void refuse_own_input(const LogOptions& options) {
  std::error_code absent;
  if (std::filesystem::equivalent(options.file, options.output, absent)) {
    throw ConfigError(options.output + " is the log " + options.file +
                      " itself, which would be lost; give another output file");
  }
}

int show_info(const LogOptions& options) {
  LogInput log(options.file);
  LogStatistics statistics;
  LogEvent event;
  while (log.read(event)) statistics.add(event);
  std::cout << (options.as_json ? statistics.to_json() + "\n" : statistics.to_text());
  log.warn_about_damage();
  return 0;
}

/** Layout of the type of a channel's first message of a known type. */
const MessageLayout& find_layout_of_channel(const LogOptions& options) {
  LogInput log(options.file);
  bool has_messages = false;
  LogEvent event;
  while (log.read(event)) {
    if (event.channel != options.channel) continue;
    has_messages = true;
    if (const MessageLayout* layout = layout_of(event)) return *layout;
  }
  if (has_messages) {
    throw Error(
        options.channel + " in " + options.file +
        " has a type unknown to this version: the messages have changed since the recording. "
        "Read it with the nao of that version, or record again");
  }
  throw Error(options.file + " contains no message on " + options.channel +
              "; list its channels: nao log info " + options.file);
}

/** Reports skipped messages and bytes after the log's end. @return Exit status. */
int end_reading(const LogInput& log, const Undecodable& undecodable) {
  undecodable.warn();
  log.warn_about_damage();
  return 0;
}

int write_csv(const LogOptions& options) {
  refuse_own_input(options);
  MessageTable table(find_layout_of_channel(options));
  LogEvent event;
  {
    LogInput log(options.file);
    while (log.read(event)) {
      if (event.channel == options.channel) table.see(event.data);
    }
  }
  Output output(options.output);
  output.stream() << "log_time_s," << table.heading() << "\n";
  LogInput log(options.file);
  Undecodable undecodable;
  while (log.read(event)) {
    if (event.channel != options.channel) continue;
    const std::string row = table.row(event.data);
    undecodable.note(event, !row.empty());
    if (row.empty()) continue;
    output.stream() << std::to_string(log.time_of(event)) << "," << row << "\n";
  }
  output.finish();
  return end_reading(log, undecodable);
}

int write_json(const LogOptions& options) {
  refuse_own_input(options);
  const ChannelPattern selected("--channels", options.channels);
  LogInput log(options.file);
  Output output(options.output);
  const auto write = [&](const LogEvent& event, const MessageLayout& layout,
                         const std::string& message) {
    JsonWriter json;
    json.begin_object();
    json.add("log_wall_utime", int64_t{event.wall_utime});
    json.add("channel", event.channel);
    json.add("type", layout.name);
    json.add_json("message", message);
    output.stream() << json.take() << "\n";
  };
  const Undecodable undecodable = read_as_json(log, selected, write);
  output.finish();
  return end_reading(log, undecodable);
}

int write_mcap(const LogOptions& options) {
  refuse_own_input(options);
  LogInput log(options.file);
  return end_reading(log, convert_to_mcap(log, ChannelPattern("--channels", options.channels),
                                          options.output, options.model, options.robot));
}

int write_cut(const LogOptions& options) {
  refuse_own_input(options);
  LogInput log(options.file);
  Output output(options.output);
  int64_t number = 0;
  const auto write = [&](LogEvent& event, double /*time*/) {
    event.number = number++;
    const auto bytes = encode_log_event(event);
    output.stream().write(reinterpret_cast<const char*>(bytes.data()),
                          static_cast<std::streamsize>(bytes.size()));
  };
  read_part(log, options.part, write);
  if (number == 0) throw Error(options.file + " contains no message between these times");
  output.finish();
  log.warn_about_damage();
  return 0;
}

CommandLine* add_log_subcommand(CommandLine& log, Invocation& invocation,
                                const std::shared_ptr<LogOptions>& options, const std::string& name,
                                const std::string& description, int (*run)(const LogOptions&)) {
  CommandLine* command = log.add_subcommand(name, description);
  command->add_option("file", options->file, "Log of scripts/record")->required();
  invocation.on(*command, [options, run](const auto& common) {
    options->robot = common.robot;
    return run(*options);
  });
  return command;
}

}  // namespace

void add_log_command(CommandLine& app, Invocation& invocation) {
  CommandLine* log = app.add_subcommand(kLogSubcommand.name, kLogSubcommand.help);
  log->require_subcommand();
  const auto options = std::make_shared<LogOptions>();
  const auto add_channels = [&](CommandLine* command) {
    command->add_option(
        "--channels", options->channels,
        "Only channels whose whole name matches this (extended) regular expression");
  };
  const auto add_output = [&](CommandLine* command) {
    command->add_option("--output", options->output, "File to write (default: stdout)");
  };

  CommandLine* info = add_log_subcommand(
      *log, invocation, options, "info",
      "Channels with type, rate, longest gap, size and lost messages", show_info);
  info->add_flag("--json", options->as_json, "As JSON");

  CommandLine* csv =
      add_log_subcommand(*log, invocation, options, "csv",
                         "One channel as a table for pandas or a spreadsheet", write_csv);
  csv->add_option("channel", options->channel, "Such as NAO_ROBOT_STATE")->required();
  add_output(csv);

  CommandLine* json = add_log_subcommand(*log, invocation, options, "json",
                                         "One line of JSON for every message", write_json);
  add_channels(json);
  add_output(json);

  CommandLine* mcap = add_log_subcommand(
      *log, invocation, options, "mcap",
      "An MCAP file with JSON schemas, for Foxglove and PlotJuggler; transforms, images and scene "
      "in Foxglove's own schemas",
      write_mcap);
  mcap->add_option("output", options->output, "File to write, such as run.mcap")->required();
  add_model_option(*mcap, options->model);
  add_channels(mcap);

  CommandLine* cut = add_log_subcommand(*log, invocation, options, "cut",
                                        "A part of a log, as a log of its own", write_cut);
  cut->add_option("output", options->output, "File to write")->required();
  add_part_options(*cut, options->part);
  add_log_player(*log, invocation);
}

}  // namespace nao
