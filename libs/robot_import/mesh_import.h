#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

#include "rendering/mesh.h"

namespace nao {

/** Corners of a mesh file (STL, OBJ, DAE, GLB and what else assimp reads), all parts in one frame.
 * A child process reads it, see run_limited(): a file from elsewhere can make assimp crash.
 * @param scale  Factors along x, y, z. @return m.
 * @throws ModelError  if the file cannot be read or has no triangle. */
std::vector<Eigen::Vector3d> read_mesh_points(const std::filesystem::path& file,
                                              const Eigen::Vector3d& scale);

/** Error to which meshes are simplified, m: see simplified(). Chosen: a quarter of a pixel where a
 * robot of 1.3 m fills the height of a phone's screen of 640 pixels. */
constexpr double kFinestError = 0.0005;

/** Writes a mesh in metres as GLB, with its materials' colors, simplified.
 * @param color  Of parts whose file states no material, such as all of an STL.
 * @param error  m. @throws ModelError  as above, or if the file cannot be written. */
void convert_mesh(const std::filesystem::path& source, const Eigen::Vector3d& scale,
                  const std::optional<Color>& color, const std::filesystem::path& target,
                  double error = kFinestError);

/** Writes a mesh in metres as GLB, in one color. @throws ModelError  if it cannot be written. */
void write_mesh(const Mesh& mesh, const Color& color, const std::filesystem::path& target);

/** Simplifies converted meshes in place, with an error that is doubled up to 16 mm, until they have
 * 5 MB together. @throws ModelError  as convert_mesh(). */
void limit_meshes(const std::set<std::filesystem::path>& files);

/** A primitive about points: a capsule along the longest edge of their box where its length is at
 * least 1.6 times the others' mean and these differ by less than a half, else the box itself. */
struct FittedShape {
  bool is_capsule = false;
  /** Frame of the shape; a capsule stands along its z axis. */
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /** Box: edge lengths, m. */
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  /** Capsule: m; the length is that between the centers of its ends. */
  double radius = 0;
  double length = 0;
};

/** @param points  At least one, m. */
FittedShape fit_shape(const std::vector<Eigen::Vector3d>& points);

}  // namespace nao
