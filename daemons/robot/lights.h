#pragma once

#include <array>
#include <string>
#include <vector>

#include "daemons/robot/eyes.h"
#include "lola/frame.h"
#include "lola/lola_map.h"

namespace nao::robot {

/** The robot's lights: colors that light_command_t asks for, over those that show the robot's
 * state. */
class Lights {
 public:
  using Color = std::array<double, 3>;

  /** @param map  Must outlive this. */
  explicit Lights(const LolaMap& map);

  /** @return false if there is no group of that name, or a part of the color is not in [0, 1]. */
  [[nodiscard]] bool check(const std::string& name, const Color& color) const;
  /** @param duration  s; 0: until replaced. */
  void set(const std::string& name, const Color& color, double duration);

  /** @param dt  s. @param command  Gets the lights' keys. Allocates nothing. */
  void step(EyeState eyes, Phase phase, double dt, LolaCommand& command);

  /** As shown, in LolaMap's order. */
  const std::vector<Color>& shown() const { return shown_; }

 private:
  struct Setting {
    Color color{};
    /** s that it is still shown; infinity: until replaced; 0: not set. */
    double time_left = 0;
  };

  const LolaMap& map_;
  std::vector<Setting> settings_;
  std::vector<Color> shown_;
};

}  // namespace nao::robot
