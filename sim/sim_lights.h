#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "messages/light_settings.h"

namespace nao::sim {

/** Lights of a simulated robot on the bus: dark until a command sets them. Such a robot has no
 * faults to show. */
class SimLights {
 public:
  explicit SimLights(std::vector<std::string> names)
      : names_(std::move(names)), settings_(names_.size()) {}

  const std::vector<std::string>& names() const { return names_; }

  /** @return Why the command is refused; nothing if the lights obey. */
  [[nodiscard]] std::optional<Reason> take(const LightCommand& command) {
    if (auto fault = check(command, names_)) return fault;
    for (size_t i = 0; i < command.light_names.size(); ++i) {
      const auto found = std::find(names_.begin(), names_.end(), command.light_names[i]);
      settings_.set(static_cast<size_t>(found - names_.begin()), command.light_rgb[i],
                    command.duration);
    }
    return std::nullopt;
  }

  LightColor color(size_t light) const { return settings_.color(light).value_or(LightColor{}); }

  /** @param dt  s. */
  void step(double dt) { settings_.step(dt); }

  /** All lights are dark again. */
  void reset() { settings_ = LightSettings(names_.size()); }

 private:
  std::vector<std::string> names_;
  LightSettings settings_;
};

}  // namespace nao::sim
