#include "daemons/robot/lights.h"

#include <algorithm>
#include <limits>

namespace nao::robot {
namespace {

/** Keys of LoLA's commands that show the state. */
bool is_eye(const std::string& key) {
  return key == "LEye" || key == "REye";
}

}  // namespace

Lights::Lights(const LolaMap& map)
    : map_(map), settings_(map.lights.size()), shown_(map.lights.size()) {}

bool Lights::check(const std::string& name, const Color& color) const {
  // Written so that NaN fails, too.
  const bool is_in_range =
      std::all_of(color.begin(), color.end(), [](double part) { return part >= 0 && part <= 1; });
  return is_in_range &&
         std::any_of(map_.lights.begin(), map_.lights.end(),
                     [&](const LolaMap::Light& light) { return light.name == name; });
}

void Lights::set(const std::string& name, const Color& color, double duration) {
  for (size_t i = 0; i < settings_.size(); ++i) {
    if (map_.lights[i].name != name) continue;
    settings_[i] = {color, duration > 0 ? duration : std::numeric_limits<double>::infinity()};
  }
}

void Lights::step(EyeState eyes, Phase phase, double dt, LolaCommand& command) {
  for (size_t i = 0; i < settings_.size(); ++i) {
    const std::string& key = map_.lights[i].key;
    Setting& setting = settings_[i];
    Color color{};
    if (is_eye(key)) color = eye_color(eyes);
    if (key == "Chest") color = chest_color(phase);
    // Faults are shown whatever was asked for.
    if (setting.time_left > 0 && !(is_eye(key) && eyes == EyeState::kFault)) color = setting.color;
    setting.time_left = std::max(0.0, setting.time_left - dt);
    shown_[i] = color;
    set_light(command, key, color);
  }
}

}  // namespace nao::robot
