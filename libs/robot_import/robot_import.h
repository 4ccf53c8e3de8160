#pragma once

#include <filesystem>

#include "robot_import/finding.h"

namespace nao {

/** Writes a robot's folder from a URDF: the repaired URDF, meshes, robot.yaml, postures.yaml and
 * transitions.yaml, found from the structure.
 * @param folder  Folder to make; must not exist.
 * @return What was wrong, assumed or is missing.
 * @throws ModelError  if the URDF cannot be read or is not a humanoid's; the folder is then
 * removed. */
Findings import_robot(const std::filesystem::path& urdf, const std::filesystem::path& folder);

/** Lists the parts that a robot's folder lacks for standing, walking, postures and kicks.
 * @throws ModelError  if it cannot be loaded. */
Findings check_robot(const std::filesystem::path& folder);

}  // namespace nao
