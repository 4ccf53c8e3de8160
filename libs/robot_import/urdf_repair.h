#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "robot_import/finding.h"

namespace nao {

/** Corners of the meshes that collided, in the frames of their links, m: by the link's name and the
 * number of the collision shape that stands for the mesh; of a link without collision shapes those
 * of its visuals, as number -1. */
using MeshPoints = std::map<std::pair<std::string, int>, std::vector<Eigen::Vector3d>>;

/** A URDF as RobotModel reads it. */
struct RepairedUrdf {
  std::string text;
  /** Name of the root link. */
  std::string root;
  MeshPoints mesh_points;
  /** Lines of the file's links and joints, by "link NAME" and "joint NAME". */
  std::map<std::string, int> lines;
  Findings findings;
};

/** Makes a URDF of any origin readable by RobotModel, and lists what was wrong with it.
 *
 * Meshes named by package:// or relative paths are searched beside the file and in the folders
 * above it, and written in metres as GLB; mesh collision shapes become capsules or boxes about
 * them. Continuous joints get limits; prismatic, planar and floating joints are held (fixed).
 * Missing limits and impossible inertias are replaced. More in urdf_dialect.h, urdf_mechanism.h.
 *
 * @param file    The URDF; output of xacro, not its input. @param folder  Existing; its subfolder
 *   "meshes" receives the meshes.
 * @throws ModelError  if the file is not a URDF, with file, line and what to do. */
RepairedUrdf repair_urdf(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace nao
