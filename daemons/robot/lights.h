#pragma once

#include <string>
#include <vector>

#include "daemons/robot/eyes.h"
#include "lola/frame.h"
#include "lola/lola_map.h"
#include "messages/light_settings.h"

namespace nao::robot {

/** The robot's lights: colors that light_command_t requests, over those that show the robot's
 * state. */
class Lights {
 public:
  /** @param map  Must outlive this. */
  explicit Lights(const LolaMap& map);

  /** The groups of lights, in LolaMap's order. */
  const std::vector<std::string>& names() const { return names_; }
  /** @param command  Checked against names(). */
  void set(const LightCommand& command);

  /** @param dt  s. @param command  Gets the lights' keys. Allocates nothing. */
  void step(EyeState eyes, Phase phase, double dt, LolaCommand& command);

  /** As shown, in LolaMap's order. */
  const std::vector<LightColor>& shown() const { return shown_; }

 private:
  const LolaMap& map_;
  std::vector<std::string> names_;
  LightSettings settings_;
  std::vector<LightColor> shown_;
};

}  // namespace nao::robot
