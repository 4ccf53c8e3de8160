#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "messages/light_command.h"

namespace nao {

/** Colors that light commands have set. A color with a duration is shown over the one that is set
 * until replaced, which is shown again afterwards. After the construction nothing allocates. */
class LightSettings {
 public:
  explicit LightSettings(size_t num_lights) : settings_(num_lights) {}

  /** @param duration  s; 0: until replaced. */
  void set(size_t light, const LightColor& color, double duration) {
    Setting& setting = settings_[light];
    setting.time_left = duration;
    if (duration > 0) {
      setting.passing = color;
    } else {
      setting.lasting = color;
    }
  }

  /** @return The color of a light; nothing if none is set. */
  std::optional<LightColor> color(size_t light) const {
    const Setting& setting = settings_[light];
    return setting.time_left > 0 ? setting.passing : setting.lasting;
  }

  /** @param dt  s. */
  void step(double dt) {
    for (Setting& setting : settings_) setting.time_left = std::max(0.0, setting.time_left - dt);
  }

 private:
  struct Setting {
    std::optional<LightColor> lasting;
    std::optional<LightColor> passing;
    /** s that `passing` is still shown. */
    double time_left = 0;
  };

  std::vector<Setting> settings_;
};

}  // namespace nao
