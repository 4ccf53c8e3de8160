#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace nao {

/** @throws Error  if the file cannot be read. */
std::string read_file(const std::filesystem::path& file);

/** Digest of a text that differs for texts which differ by accident, for comparison.
 *
 * Source: FNV-1a with 64 bits, G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV
 * Non-Cryptographic Hash Algorithm", IETF draft. */
uint64_t digest(const std::string& text);
/** Digest of the YAML and URDF files of a folder, in the order of their names.
 * @param except  File that does not count. */
uint64_t digest_files(const std::filesystem::path& folder, const std::filesystem::path& except);

}  // namespace nao
