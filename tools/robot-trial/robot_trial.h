#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tools/robot-trial/robot_card.h"

namespace nao {

/** Simulates an imported robot, writes the settings that it stands and walks with into its folder,
 * its card as card.json, and images of its postures.
 * @param minutes       Time of the search for settings on two free cores; the last one may end
 *                      later.
 * @param tune_minutes  Time of the search for a better gait that follows; 0: none.
 * @param progress      Receives a line after each settings.
 * @throws Error  if a file cannot be written or the robot cannot be simulated. */
RobotCard try_robot(const std::filesystem::path& folder, double minutes, double tune_minutes,
                    const std::function<void(const std::string&)>& progress);

}  // namespace nao
