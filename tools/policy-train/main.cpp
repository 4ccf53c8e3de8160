// nao-batch-simulation: steps many robots together for a policy that is being trained:
// docs/policies.md

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/program.h"
#include "tools/policy-train/batch_simulation.h"
#include "tools/policy-train/policy_mirror.h"

namespace nao::policy_train {
namespace {

/** Memory that this process and another one see. */
class SharedMemory {
 public:
  /** @throws ConfigError  if the file cannot be written to. */
  SharedMemory(const std::string& file, size_t size) : size_(size) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor >= 0 && ::ftruncate(descriptor, static_cast<off_t>(size)) == 0) {
      memory_ = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    }
    const int error = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (memory_ == MAP_FAILED) {
      throw ConfigError("cannot map " + std::to_string(size) + " bytes of " + file + ": " +
                        std::strerror(error));
    }
  }
  ~SharedMemory() { ::munmap(memory_, size_); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  template <class Number>
  Number* at(size_t offset) {
    return reinterpret_cast<Number*>(static_cast<char*>(memory_) + offset);
  }

 private:
  size_t size_;
  void* memory_ = MAP_FAILED;
};

/** Places of arrays behind one another in memory, as they are told to the other process. */
struct Layout {
  nlohmann::json arrays;
  size_t size = 0;

  size_t add(const char* name, const char* type, size_t bytes, int rows, int columns) {
    const size_t offset = size;
    arrays[name] = {{"offset", offset}, {"type", type}, {"shape", {rows, columns}}};
    constexpr size_t kAlignment = 64;
    const size_t end = offset + bytes * static_cast<size_t>(rows) * static_cast<size_t>(columns);
    size = (end + kAlignment - 1) / kAlignment * kAlignment;
    return offset;
  }
};

nlohmann::json to_json(const Reflection& reflection) {
  return {{"index", reflection.index}, {"sign", reflection.sign}};
}

void serve(const EnvironmentOptions& options, int size, int num_threads, uint64_t seed,
           const std::string& file) {
  const PolicyManifest& manifest = *options.manifest;
  Layout layout;
  const size_t actions = layout.add("actions", "float32", 4, size, manifest.num_actions());
  const size_t observations =
      layout.add("observations", "float32", 4, size, manifest.num_observations());
  const size_t final_observations =
      layout.add("final_observations", "float32", 4, size, manifest.num_observations());
  const size_t privileged = layout.add("privileged", "float32", 4, size, kNumPrivileged);
  const size_t terms = layout.add("reward_terms", "float32", 4, size, kNumRewardTerms);
  const size_t terminated = layout.add("terminated", "uint8", 1, size, 1);
  const size_t truncated = layout.add("truncated", "uint8", 1, size, 1);
  SharedMemory memory(file, layout.size);
  BatchArrays arrays;
  arrays.actions = memory.at<float>(actions);
  arrays.observations = memory.at<float>(observations);
  arrays.final_observations = memory.at<float>(final_observations);
  arrays.privileged = memory.at<float>(privileged);
  arrays.reward_terms = memory.at<float>(terms);
  arrays.terminated = memory.at<uint8_t>(terminated);
  arrays.truncated = memory.at<uint8_t>(truncated);
  BatchSimulation batch(options, size, num_threads, seed);
  const nlohmann::json description = {
      {"arrays", layout.arrays},
      {"reward_terms", reward_term_names()},
      {"period", manifest.period},
      {"action_clip", manifest.action_clip},
      {"reflections",
       {{"observations", to_json(reflect_observation(*options.model, manifest))},
        {"actions", to_json(reflect_action(*options.model, manifest))},
        {"privileged", to_json(reflect_privileged())}}}};
  std::cout << description.dump() << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string request;
    words >> request;
    if (line == "step") {
      batch.step(arrays);
    } else if (request == "reset" && (line == request || words >> seed)) {
      if (line != request) batch.seed(seed);
      batch.reset(arrays);
    } else {
      throw ConfigError("unknown request \"" + line + "\" on stdin: reset, reset SEED or step");
    }
    std::cout << "done" << std::endl;
  }
}

}  // namespace
}  // namespace nao::policy_train

int main(int argc, char** argv) {
  using namespace nao::policy_train;
  nao::CommandLine app(
      "Steps many robots together for a policy that is being trained. Prints a line of JSON that "
      "describes the arrays in FILE, then answers each line on stdin, `reset`, `reset SEED` or "
      "`step`, with `done`.",
      "nao-batch-simulation");
  nao::CommonOptions common;
  common.log_level = "warning";
  nao::add_log_option(app, common);
  std::string model = "t1";
  std::string manifest;
  std::string memory;
  std::string disturbances = "default";
  int size = 256;
  int num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  uint64_t seed = 1;
  std::vector<double> command;
  EnvironmentOptions options;
  nao::add_model_option(app, model);
  app.add_option("--policy", manifest, "The policy's policy.yaml (docs/policies.md)")->required();
  app.add_option("--memory", memory, "File that is mapped for the arrays, such as /dev/shm/batch")
      ->required();
  app.add_option("--size", size, "Number of robots")->range(1, 65536);
  app.add_option("--threads", num_threads, "Threads that step them")->range(1, 256);
  app.add_option("--seed", seed, "Seed of the first robot; the others have the following ones");
  app.add_option("--engine", options.engine,
                 "Physics engine: fast, simbody, or mujoco where it was built");
  app.add_option(
      "--disturbances", disturbances,
      "Disturbances to draw for each robot: none, default, moderate, real, or entries of "
      "real");
  app.add_option("--push", options.push,
                 "Greatest impulse of pushes about every three seconds, N s for each kg")
      ->range(0.0, 10.0);
  app.add_option("--rest", options.rest_share, "Share of the episodes with velocity 0")
      ->range(0.0, 1.0);
  app.add_option("--assist", options.assist,
                 "Pull on the torso of a robot that learns to get up, at first, as a fraction of "
                 "its weight")
      ->range(0.0, 1.0);
  app.add_option("--episode", options.episode_time, "Longest episode, s")->range(1.0, 1000.0);
  app.add_option("--command", command,
                 "Velocity VX VY WZ of all episodes, m/s and rad/s, instead of drawn ones")
      ->count(3);
  return nao::run_program(app, common, argc, argv, [&] {
    auto robot = std::make_shared<nao::RobotModel>(
        nao::RobotModel::load(nao::data_path() / "robots" / model));
    options.manifest =
        std::make_shared<nao::PolicyManifest>(nao::PolicyManifest::load(*robot, manifest));
    options.model = robot;
    options.scene = nao::SceneFile::find("empty");
    options.disturbances =
        std::make_shared<nao::sim::DisturbanceSet>(nao::sim::DisturbanceSet::find(disturbances));
    if (!command.empty()) options.command = Eigen::Vector3d(command[0], command[1], command[2]);
    serve(options, size, num_threads, seed, memory);
  });
}
