// In a build without OpenCV.

#include "common/error.h"
#include "policy/policy_network.h"

namespace nao {

std::unique_ptr<PolicyNetwork> load_policy_network(const std::filesystem::path& file,
                                                   int /*num_observations*/, int /*num_actions*/) {
  throw ModelError(file.string() +
                   ": this build runs no networks; install OpenCV (scripts/setup --with vision) "
                   "and build again");
}

}  // namespace nao
