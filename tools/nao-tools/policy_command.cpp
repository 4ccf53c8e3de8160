// nao policy: checks a policy's manifest and network, drafts a manifest.

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "common/command_line.h"
#include "common/error.h"
#include "common/output_file.h"
#include "policy/policy.h"
#include "policy/policy_runner.h"
#include "policy/walk_draft.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/tools_subcommands.h"

namespace nao {
namespace {

/** The robot in whose folder the manifest lies, or the named one. */
RobotModel load_robot(const std::filesystem::path& manifest_file, const std::string& name) {
  if (!name.empty()) return RobotModel::find(name);
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(manifest_file).parent_path().parent_path().parent_path();
  if (!std::filesystem::exists(folder / "robot.yaml")) {
    throw ConfigError(manifest_file.string() +
                      " does not lie in robots/NAME/policies/POLICY/; say which robot it is for: "
                      "--model NAME");
  }
  return RobotModel::load(folder);
}

std::string own_or(double gain) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", gain);
  return std::isnan(gain) ? "own" : text;
}

void print_observations(const PolicyManifest& manifest) {
  int index = 0;
  for (const PolicyTerm& term : manifest.terms) {
    const int count = term.size * (manifest.is_by_step ? 1 : term.num_steps);
    std::printf("  %3d to %3d  %-18s %d x %d step%s, scale %g\n", index, index + count - 1,
                to_string(term.quantity), term.size, term.num_steps, term.num_steps > 1 ? "s" : "",
                term.scale.front());
    index += count;
  }
  if (manifest.is_by_step) std::printf("  (of each step)\n");
}

/** What the network does with a robot that stands at the default angles. */
void print_joints(const RobotModel& model, const Policy& policy) {
  const PolicyManifest& manifest = *policy.manifest;
  PolicyRunner runner(model, manifest, *policy.network);
  PolicyInput input;
  input.joint_position = manifest.default_position;
  input.joint_velocity.assign(input.joint_position.size(), 0.0);
  const auto fault = runner.step(input, manifest.period);
  std::printf("joints: default angle, target at rest (rad), kp (N m/rad), kd (N m s/rad)\n");
  for (size_t i = 0; i < manifest.joints.size(); ++i) {
    const PolicyJoint& joint = manifest.joints[i];
    std::printf("  %2zu  %-20s %7.3f %7.3f  %6s %6s\n", i,
                model.motor_names()[static_cast<size_t>(joint.motor)].c_str(), joint.default_angle,
                runner.targets()[i], own_or(joint.stiffness).c_str(),
                own_or(joint.damping).c_str());
  }
  std::printf("an inference took %.3f ms of a step of %.0f ms\n", 1e3 * runner.inference_time(),
              1e3 * manifest.period);
  if (fault) throw Error("at rest " + *fault);
}

void check_policy(const std::string& file, const std::string& model_name) {
  std::filesystem::path manifest_file = file;
  if (std::filesystem::is_directory(manifest_file)) manifest_file /= kPolicyFile;
  const RobotModel model = load_robot(manifest_file, model_name);
  const Policy policy = Policy::load(model, manifest_file);
  if (policy.manifest) {
    std::printf("%d observations:\n", policy.manifest->num_observations());
    print_observations(*policy.manifest);
  }
  if (!policy.fault.empty()) throw Error(policy.fault);
  print_joints(model, policy);
  std::printf("the robot %s can use the policy %s\n", model.name().c_str(), policy.name.c_str());
}

void draft_policy(const std::string& folder, const std::string& model_name) {
  const std::filesystem::path file = std::filesystem::path(folder) / kPolicyFile;
  if (std::filesystem::exists(file)) throw Error(file.string() + " exists already");
  const std::string text = draft_walk_policy(load_robot(file, model_name));
  std::filesystem::create_directories(folder);
  replace_file(file, text);
  std::printf("%s\n", file.c_str());
}

}  // namespace

void add_policy_command(CommandLine& app, Invocation& invocation) {
  CommandLine* policy = app.add_subcommand(kPolicySubcommand.name, kPolicySubcommand.help);
  policy->require_subcommand();
  struct Options {
    std::string file;
    std::string model;
  };
  const auto options = std::make_shared<Options>();
  const auto add_model = [options](CommandLine& command) {
    command.add_option("--model", options->model,
                       "Robot; default: the one in whose folder the file lies");
  };
  CommandLine* check = policy->add_subcommand(
      "check",
      "Load a policy and print what it observes and moves; exit status 1: it cannot be used");
  check->add_option("file", options->file, "Its policy.yaml, or the folder of it")->required();
  add_model(*check);
  invocation.on(*check, [options](const auto& /*common*/) {
    check_policy(options->file, options->model);
    return 0;
  });
  CommandLine* draft = policy->add_subcommand(
      "draft", "Write the policy.yaml of a walk that is to be trained: docs/policies.md");
  draft->add_option("folder", options->file, "robots/NAME/policies/POLICY")->required();
  add_model(*draft);
  invocation.on(*draft, [options](const auto& /*common*/) {
    draft_policy(options->file, options->model);
    return 0;
  });
}

}  // namespace nao
