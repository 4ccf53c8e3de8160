#pragma once

#include <string>
#include <vector>

#include "robot_import/finding.h"
#include "tools/robot-trial/setting_ladder.h"

namespace nao {

/** Summary of an imported robot. */
struct RobotCard {
  std::string name;
  /** kg, m, m/s, N s. */
  double mass = 0;
  double height = 0;
  double commanded_speed = 0;
  double speed = 0;
  double push = 0;
  int motors = 0;
  /** Length and width of a sole, m. */
  double sole_length = 0;
  double sole_width = 0;
  RobotSettings settings;
  /** Of `runs` seeds. */
  int runs = 0;
  int stands = 0;
  int walks = 0;
  /** Why it did not stand or walk; empty: it did. */
  std::string failure;
  /** Images of its postures, from its folder; or why there are none. */
  std::vector<std::string> images;
  std::string no_images;
  /** Findings of check_robot(). */
  Findings missing;
};

std::string to_text(const RobotCard& card);
std::string to_json(const RobotCard& card);

}  // namespace nao
