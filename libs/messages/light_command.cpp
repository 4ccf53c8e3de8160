#include "messages/light_command.h"

#include <algorithm>
#include <cmath>

#include "common/joined.h"
#include "messages/command.h"

namespace nao {
std::optional<Reason> check(const LightCommand& command,
                            const std::vector<std::string>& known_names) {
  if (command.light_names.empty()) return Reason("lights-missing");
  for (size_t i = 0; i < command.light_names.size(); ++i) {
    const std::string& name = command.light_names[i];
    if (std::find(known_names.begin(), known_names.end(), name) == known_names.end()) {
      return Reason("light-unknown", {quoted(name), joined(known_names)});
    }
    // Written so that NaN fails, too.
    const LightColor& rgb = command.light_rgb[i];
    if (!std::all_of(rgb.begin(), rgb.end(), [](double part) { return part >= 0 && part <= 1; })) {
      return Reason("light-color-out-of-range", {name});
    }
  }
  if (!(command.duration >= 0 && std::isfinite(command.duration))) {
    return Reason("light-duration-out-of-range", {to_argument(command.duration)});
  }
  return std::nullopt;
}

LightCommand to_light_command(const naolcm::light_command_t& message) {
  LightCommand command;
  command.light_names = message.light_names;
  for (const std::vector<double>& rgb : message.light_rgb) {
    command.light_rgb.push_back({rgb[0], rgb[1], rgb[2]});
  }
  command.duration = message.duration;
  return command;
}

naolcm::light_command_t to_message(const LightCommand& command) {
  naolcm::light_command_t message{};
  message.num_lights = static_cast<int32_t>(command.light_names.size());
  message.light_names = command.light_names;
  for (const LightColor& rgb : command.light_rgb) {
    message.light_rgb.emplace_back(rgb.begin(), rgb.end());
  }
  message.duration = command.duration;
  return message;
}

}  // namespace nao
