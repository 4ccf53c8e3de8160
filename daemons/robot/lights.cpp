#include "daemons/robot/lights.h"

#include <algorithm>

namespace nao::robot {
namespace {

/** Keys of LoLA's commands that show the state. */
bool is_eye(const std::string& key) {
  return key == "LEye" || key == "REye";
}

}  // namespace

Lights::Lights(const LolaMap& map)
    : map_(map), settings_(map.lights.size()), shown_(map.lights.size()) {
  for (const LolaMap::Light& light : map.lights) names_.push_back(light.name);
}

void Lights::set(const LightCommand& command) {
  for (size_t i = 0; i < command.light_names.size(); ++i) {
    const auto found = std::find(names_.begin(), names_.end(), command.light_names[i]);
    if (found == names_.end()) continue;
    settings_.set(static_cast<size_t>(found - names_.begin()), command.light_rgb[i],
                  command.duration);
  }
}

// Order: state lights, then settings of the bus, which cover all but faults in the eyes.
void Lights::step(EyeState eyes, Phase phase, double dt, LolaCommand& command) {
  for (size_t i = 0; i < shown_.size(); ++i) {
    const std::string& key = map_.lights[i].key;
    LightColor color{};
    if (is_eye(key)) color = eye_color(eyes);
    if (key == "Chest") color = chest_color(phase);
    // Faults are shown in any case.
    const auto setting = settings_.color(i);
    if (setting && !(is_eye(key) && eyes == EyeState::kFault)) color = *setting;
    shown_[i] = color;
    set_light(command, key, color);
  }
  settings_.step(dt);
}

}  // namespace nao::robot
