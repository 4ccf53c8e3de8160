// nao motion: taught motions, which nao-motion-files keeps.

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <naolcm/motion_file_result_t.hpp>
#include <optional>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/text_file.h"
#include "common/wall_clock.h"
#include "messages/command_publisher.h"
#include "messages/motion_file.h"
#include "tools/nao/command_exchange.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

/** Longest check of one motion, and of another one before it, s; see nao-motion-files. */
constexpr double kCheckTimeout = 120;

struct MotionArguments {
  std::string file;
  std::string name;
  bool may_replace = false;
};

/** Sends a command to nao-motion-files until it answers.
 * @param timeout  s. @return Nothing if it does not answer, or Ctrl-C ended the waiting. */
std::optional<MotionFileResult> ask_motion_files(const CommonOptions& common,
                                                 MotionFileCommand command, double timeout) {
  EventLoop loop;
  Bus bus(common.lcm_url);
  const RobotChannels channels(common.robot);
  const CommandPublisher commands(bus, channels);
  command.source = "nao." + std::to_string(getpid());
  command.id = wall_utime();
  std::optional<MotionFileResult> answer;
  double last_heard = monotonic_seconds();
  bus.subscribe<naolcm::motion_file_result_t>(
      channels.motion_file_result, Bus::Queue::kAll, [&](const auto& message) {
        last_heard = monotonic_seconds();
        const auto result = from_message(message);
        if (!result || result->source != command.source || result->id != command.id) return;
        answer = result;
        loop.stop("end");
      });
  // As of motion_file_command_t.
  CommandExchange exchange("nao-motion-files", last_heard,
                           {.repeat_period = 1.0, .answer_timeout = timeout});
  loop.on_readable(bus.descriptor(), [&bus] { bus.handle(); });
  loop.every(0.02, [&] {
    const double now = monotonic_seconds();
    if (exchange.should_send(now)) {
      commands.publish(channels.motion_file_command, to_message(command), command.source,
                       command.id);
    }
    // While it checks a motion it still lists all of them once a second.
    if (exchange.outcome(now) || now - last_heard > kListenTimeout) loop.stop("timeout");
  });
  loop.run();
  return answer;
}

/** As ask_motion_files(), and prints why it failed on stderr. @return Nothing if it failed. */
std::optional<MotionFileResult> ask_motion_files_or_complain(const CommonOptions& common,
                                                             const MotionFileCommand& command,
                                                             const std::string& what,
                                                             double timeout) {
  auto result = ask_motion_files(common, command, timeout);
  if (!result) {
    std::fprintf(stderr, "nao: motion %s: nao-motion-files does not answer; is it running?\n",
                 what.c_str());
    return std::nullopt;
  }
  if (result->is_ok) return result;
  const std::string where =
      result->keyframe >= 0 ? "keyframe " + std::to_string(result->keyframe + 1) + ": " : "";
  std::fprintf(stderr, "nao: motion %s: refused: %s%s\n", what.c_str(), where.c_str(),
               result->sentence.c_str());
  if (!result->repair.empty()) {
    std::fprintf(stderr, "nao: a safe motion, %s, follows on stdout\n", result->repair.c_str());
    std::printf("%s", result->yaml.c_str());
  }
  return std::nullopt;
}

int list_motions(const CommonOptions& common) {
  MotionFileCommand command;
  command.operation = MotionFileOperation::kList;
  const auto result = ask_motion_files_or_complain(common, command, "list", kListenTimeout);
  if (!result) return 1;
  for (const std::string& name : result->names) std::printf("%s\n", name.c_str());
  return 0;
}

int print_motion(const CommonOptions& common, const std::string& name) {
  MotionFileCommand command;
  command.operation = MotionFileOperation::kGet;
  command.name = name;
  const auto result = ask_motion_files_or_complain(common, command, "get", kListenTimeout);
  if (!result) return 1;
  std::printf("%s", result->yaml.c_str());
  return 0;
}

int delete_motion(const CommonOptions& common, const std::string& name) {
  MotionFileCommand command;
  command.operation = MotionFileOperation::kDelete;
  command.name = name;
  return ask_motion_files_or_complain(common, command, "delete", kListenTimeout) ? 0 : 1;
}

int check_or_save_motion(const CommonOptions& common, const MotionArguments& options, bool saves) {
  MotionFileCommand command;
  command.operation = saves ? MotionFileOperation::kSave : MotionFileOperation::kCheck;
  command.yaml = read_file(options.file);
  command.name = options.name;
  command.may_replace = options.may_replace;
  const char* what = saves ? "save" : "check";
  if (!ask_motion_files_or_complain(common, command, what, kCheckTimeout)) return 1;
  std::printf("motion %s: %s\n", what, saves ? "saved" : "safe");
  return 0;
}

}  // namespace

void add_motion_command(CommandLine& app, Invocation& invocation) {
  CommandLine* motion =
      app.add_subcommand("motion", "List, check, save, get, delete and play taught motions");
  motion->require_subcommand();
  const auto options = std::make_shared<MotionArguments>();
  const auto add = [&](const std::string& name, const std::string& help,
                       std::function<int(const CommonOptions&)> run) {
    CommandLine* subcommand = motion->add_subcommand(name, help);
    invocation.on(*subcommand, std::move(run));
    return subcommand;
  };
  const auto add_file = [&options](CommandLine* subcommand) {
    subcommand->add_option("file", options->file, "File of the motion, YAML")
        ->required()
        ->existing_file();
  };
  const auto add_name = [&options](CommandLine* subcommand) {
    subcommand->add_option("name", options->name, "Name of the motion")->required();
  };
  add("list", "Print the names of the saved motions", list_motions);
  add_file(add("check", "Check whether the robot can play a motion; simulates it for some seconds",
               [options](const CommonOptions& common) {
                 return check_or_save_motion(common, *options, false);
               }));
  CommandLine* save = add("save", "Check a motion and save it", [options](const auto& common) {
    return check_or_save_motion(common, *options, true);
  });
  add_file(save);
  save->add_option("--name", options->name, "Name to save it by; default: the one in the file");
  save->add_flag("--replace", options->may_replace, "Replace a saved motion of this name");
  add_name(add("get", "Print the file of a saved motion", [options](const CommonOptions& common) {
    return print_motion(common, options->name);
  }));
  add_name(add("delete", "Delete a saved motion", [options](const CommonOptions& common) {
    return delete_motion(common, options->name);
  }));
  add_name(
      add("play", "Play a saved motion; returns at its end",
          [options](const CommonOptions& common) { return run_action(common, options->name); }));
}

}  // namespace nao
