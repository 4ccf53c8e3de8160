#include "robot_model/policy_files.h"

#include "robot_model/robot_description.h"

namespace nao {

std::set<std::filesystem::path> find_policy_files(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> files;
  const std::filesystem::path policies = folder / kPolicyFolder;
  if (!std::filesystem::is_directory(policies)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(policies)) {
    const std::filesystem::path file = entry.path() / kPolicyFile;
    if (std::filesystem::exists(file)) files.insert(file);
  }
  return files;
}

}  // namespace nao
