#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "policy/policy_manifest.h"
#include "policy/policy_network.h"
#include "robot_model/robot_model.h"

namespace nao {

/** A policy of a robot: manifest and network, or why it cannot be used. */
struct Policy {
  /** Name of its folder. */
  std::string name;
  /** The manifest's file; the network lies beside it. */
  std::filesystem::path manifest_file;
  /** Present, both, if there is no fault. */
  std::optional<PolicyManifest> manifest;
  std::shared_ptr<PolicyNetwork> network;
  /** Why it cannot be used; empty if it can. */
  std::string fault;

  /** Reads manifest and network and runs the network some times. Never throws for a wrong file. */
  static Policy load(const RobotModel& model, const std::filesystem::path& manifest_file);

  /** `fault`, or that a file was removed since. Looks at the disk. */
  std::string find_fault() const;
};

/** All policies in a robot's folder policies/, by name. */
std::vector<Policy> load_policies(const RobotModel& model);

}  // namespace nao
