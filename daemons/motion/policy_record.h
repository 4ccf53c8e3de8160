#pragma once

#include <string>
#include <vector>

namespace nao::motion {

/** One step of a policy; policy_state_t documents every field of the same name. */
struct PolicyRecord {
  std::string policy;
  std::vector<float> observation;
  std::vector<std::string> joint_names;
  std::vector<float> action;
  /** Processor time, s. */
  double inference_time = 0;
};

}  // namespace nao::motion
