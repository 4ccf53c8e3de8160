#pragma once

#include <array>
#include <naolcm/light_command_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "messages/reason.h"

namespace nao {

/** Red, green, blue, each 0 to 1. */
using LightColor = std::array<double, 3>;

/** Sets lights; light_command_t documents every field. */
struct LightCommand {
  std::vector<std::string> light_names{};
  /** (number of names). */
  std::vector<LightColor> light_rgb{};
  /** s; 0: until replaced. */
  double duration = 0;
};

/** @param known_names  The robot's lights.
 * @return Nothing, or the fault: "lights-missing", "light-unknown", "light-color-out-of-range" or
 *   "light-duration-out-of-range". */
[[nodiscard]] std::optional<Reason> check(const LightCommand& command,
                                          const std::vector<std::string>& known_names);

LightCommand to_light_command(const naolcm::light_command_t& message);

/** The message without time, source and number. */
naolcm::light_command_t to_message(const LightCommand& command);

}  // namespace nao
