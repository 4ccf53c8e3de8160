#include "tools/foxglove/client_publisher.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "common/channels.h"
#include "common/json_text.h"
#include "inspection/message_from_json.h"
#include "message_reflection/message_types.h"

namespace nao::foxglove {
namespace {

using Json = nlohmann::json;

/** A channel of commands that any program may send. */
struct CommandChannel {
  /** After the robot's name. */
  const char* name;
  const char* type;
  /** Time after which a repeated command ends, microseconds; 0 for events. Source: the .lcm files.
   */
  int64_t validity;
};

constexpr CommandChannel kCommands[] = {
    {"_WALK_COMMAND", "walk_command_t", 500'000},
    {"_MOVE_TO_COMMAND", "move_to_command_t", 0},
    {"_POSTURE_COMMAND", "posture_command_t", 0},
    {"_JOINT_CHANGE_COMMAND", "joint_change_command_t", 0},
    {"_ACTION_COMMAND", "action_command_t", 0},
    {"_STOP_COMMAND", "stop_command_t", 0},
    {"_LIGHT_COMMAND", "light_command_t", 0},
    {"_SPEECH_COMMAND", "speech_command_t", 0},
    {"_PLAY_COMMAND", "play_command_t", 2'000'000},
};

/** nullptr if it is not a command channel of the robot. */
const CommandChannel* find_command(const std::string& robot, const std::string& channel) {
  const auto found =
      std::find_if(std::begin(kCommands), std::end(kCommands),
                   [&](const CommandChannel& command) { return channel == robot + command.name; });
  return found == std::end(kCommands) ? nullptr : &*found;
}

const MessageType* find_type(const std::string& name) {
  for (const MessageType& type : message_types()) {
    if (type.name == name) return &type;
  }
  return nullptr;
}

}  // namespace

ClientPublisher::ClientPublisher(std::string source, std::string robot, Clock clock,
                                 Clock robot_clock, Send send)
    : source_(std::move(source)),
      robot_(std::move(robot)),
      clock_(std::move(clock)),
      robot_clock_(std::move(robot_clock)),
      send_(std::move(send)) {}

std::string ClientPublisher::type_of(const std::string& channel) const {
  if (channel == kWorldCommandChannel) return "world_command_t";
  const CommandChannel* const command = find_command(robot_, channel);
  return command == nullptr ? "" : command->type;
}

std::string ClientPublisher::check(const std::string& channel, const std::string& encoding) const {
  if (type_of(channel).empty()) {
    std::string channels = kWorldCommandChannel;
    for (const CommandChannel& command : kCommands) channels += ", " + robot_ + command.name;
    return "Clients may publish on " + channels + ".";
  }
  if (encoding != "json") return channel + ": choose the encoding \"json\".";
  return "";
}

int64_t ClientPublisher::command_id(uint32_t client, const std::string& channel) {
  const CommandChannel* const command = find_command(robot_, channel);
  if (command == nullptr || command->validity == 0) return ++last_id_;
  const int64_t now = clock_();
  std::erase_if(repeated_, [&](const auto& entry) { return entry.second.end_utime < now; });
  const auto [entry, is_new] = repeated_.try_emplace({client, channel});
  if (is_new) entry->second.id = ++last_id_;
  entry->second.end_utime = now + command->validity;
  return entry->second.id;
}

std::string ClientPublisher::publish(uint32_t client, const std::string& channel,
                                     std::string_view json) {
  auto parsed = try_parse_json(json);
  if (!parsed || !parsed->is_object()) return "The message is no JSON object.";
  Json& message = *parsed;
  if (!message.contains("command_id")) message["command_id"] = command_id(client, channel);
  message["source"] = source_ + "." + std::to_string(client);
  message["utime"] = robot_clock_();
  message["wall_utime"] = clock_();
  const std::string type = type_of(channel);
  const EncodedMessage encoded =
      message_from_json(*find_type(type), *find_message_layout(type), message);
  if (!encoded.fault.empty()) return encoded.fault;
  send_(channel, encoded.bytes);
  return "";
}

}  // namespace nao::foxglove
