#pragma once

#include <functional>
#include <string>

namespace nao {

/** Choices of an imported robot that its URDF does not tell. */
struct RobotSettings {
  /** Error of the angle at which the servos give their greatest torque, rad. */
  double peak_error = 0.1;
  /** Factors of what the import writes: velocity, swing height, hip height, step duration, distance
   * of the feet. */
  double speed = 1;
  double swing_height = 1;
  double hip_height = 1;
  double step_duration = 1;
  double foot_distance = 1;

  bool operator==(const RobotSettings&) const = default;
};

/** What a robot does with settings. */
struct SettingsResult {
  /** Fractions of the seeds, 0 to 1. */
  double stands = 0;
  double walks = 0;
  /** How well it does where it fails, 0 to 1, such as the fraction of the time on its feet. */
  double quality = 0;
  /** Cause of the last failure; empty: none. */
  std::string failure{};

  /** Greater is better. */
  double score() const { return 4 * stands + 2 * walks + quality; }
  /** Nine of ten walks: to search for all ten would cost speed. */
  bool holds() const { return stands == 1 && walks >= 0.9; }
};

/** Climbs a short ladder of settings: the first ones that the robot stands and walks with, or else
 * the best. One setting after the other takes its values while the others keep their best ones;
 * then two or three at a time, drawn at random, the same each time.
 * @param evaluate      Called once for each settings.
 * @param is_time_over  Asked before each call but the first.
 * @param result        Receives the result of the best settings. */
RobotSettings climb_ladder(const std::function<SettingsResult(const RobotSettings&)>& evaluate,
                           const std::function<bool()>& is_time_over, SettingsResult& result);

}  // namespace nao
