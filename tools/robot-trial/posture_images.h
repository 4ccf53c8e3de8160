#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** Draws a robot in each of its postures, standing on the floor, as PNG.
 * @param folder  Where they are written; made if it is missing.
 * @return Names of the files, "ready.png".
 * @throws Error  if there is no OpenGL 3.3 without a screen, or a file cannot be written. */
std::vector<std::string> draw_postures(const RobotModel& model,
                                       const std::filesystem::path& folder);

}  // namespace nao
