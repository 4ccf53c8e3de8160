#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/log_reader.h"
#include "message_reflection/message_layout.h"
#include "tools/nao-tools/channel_pattern.h"
#include "tools/nao/subcommand.h"

namespace nao {

/** A log that a subcommand reads from its beginning. */
class LogInput {
 public:
  /** Reads the first event, so that a file of another format is rejected at once.
   * @throws Error  The file cannot be read, or contains no message. */
  explicit LogInput(const std::string& file);

  /** @param event  Receives the next event. @return false at the end. */
  bool read(LogEvent& event);

  /** Time since the log's first event, s. */
  double time_of(const LogEvent& event) const {
    return static_cast<double>(event.wall_utime - start_) * 1e-6;
  }

  /** Prints what was skipped, and steps of the recorder's clock, so far. */
  void warn_about_damage() const;

 private:
  std::optional<LogEvent> next_message();

  std::string file_;
  LogReader reader_;
  std::optional<LogEvent> next_;
  int64_t start_ = 0;
};

/** A part of a log. */
struct LogPart {
  /** Since the log's first event, s. */
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
  std::string channels = ".*";
  /** Channels to leave out; empty: none. */
  std::string without;
  /** "OLD=NEW". */
  std::vector<std::string> renames;
};

void add_part_options(CommandLine& command, LogPart& part);

/** Passes the events of a part on, renamed, with their times since the log's first event, s.
 * @throws ConfigError  A channel pattern or rename is wrong. */
void read_part(LogInput& log, const LogPart& part,
               const std::function<void(LogEvent& event, double time)>& take);

/** @return nullptr if the type is unknown. */
const MessageLayout* layout_of(const LogEvent& event);

/** Counts undecodable messages by channel, for a report at the end. */
class Undecodable {
 public:
  void note(const LogEvent& event, bool is_decoded);
  void warn() const;

 private:
  struct Channel {
    long num_undecodable = 0;
    bool has_known_type = false;
  };
  std::map<std::string, Channel> channels_;
};

/** Reads a log to its end and passes the messages of selected channels on, as JSON text.
 * @return Statistics of undecodable messages. */
Undecodable read_as_json(
    LogInput& log, const ChannelPattern& selected,
    const std::function<void(const LogEvent& event, const MessageLayout& layout,
                             const std::string& json)>& take);

/** A log becomes a file that Foxglove and Lichtblick open. @param selected  Channels of it.
 * @param model  Folder of the robot. @param robot  Its name. @return Messages that were skipped.
 * @throws Error  The file cannot be written. */
Undecodable convert_to_mcap(LogInput& log, const ChannelPattern& selected, const std::string& file,
                            const std::string& model, const std::string& robot);

/** Adds "nao log play". */
void add_log_player(CommandLine& log, Invocation& invocation);

}  // namespace nao
