#pragma once

#include <filesystem>
#include <set>

namespace nao {

/** @param folder  Of a robot. @return The manifest of each of its policies, by name. */
std::set<std::filesystem::path> find_policy_files(const std::filesystem::path& folder);

}  // namespace nao
