#pragma once

#include <filesystem>

#include "rendering/mesh.h"

namespace nao {

/** Reads a mesh file (binary glTF, or any other format that assimp reads); m, axes as in the file.
 *
 * The base colors of the materials become vertex colors; textures are ignored; missing normals are
 * computed; node transforms are applied.
 * @throws ModelError  if the file is missing, unreadable, or has no triangles or a non-finite
 *   vertex. */
Mesh load_mesh(const std::filesystem::path& file);

}  // namespace nao
