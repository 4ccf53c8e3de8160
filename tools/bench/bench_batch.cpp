// Measures the simulation of many robots for the training of policies: control steps of 20 ms for
// each second of processor time, with observations and rewards, while all legs wave.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/processor_time.h"
#include "sim/engine.h"
#include "tools/bench/run_benchmark.h"
#include "tools/policy-train/batch_simulation.h"

namespace nao::policy_train {
namespace {

constexpr int kNumRobots = 32;
// Greatest action: with its scale of 0.25 rad some robots step about, none falls soon.
constexpr double kWave = 0.4;
constexpr int kStepsOfRound = 25;

/** A policy of both legs, in the layout of unitree_rl_gym. */
std::string manifest_of(const RobotModel& model) {
  std::string joints;
  for (const LegDescription& leg : model.legs()) {
    for (const int joint : leg.joints) {
      const int motor = model.motor_of(joint);
      const std::string& name = model.motor_names()[static_cast<size_t>(motor)];
      if (joints.find(name + ",") != std::string::npos) continue;
      joints += fmt::format("  - {{name: {}, default: {:.6f}}}\n", name,
                            model.ready_posture().position[static_cast<size_t>(motor)]);
    }
  }
  return "kind: walk\nnetwork: policy.onnx\nrate: 50\nphase: {frequency: 1.25}\n"
         "action: {scale: 0.25}\nobservations:\n  - {quantity: angular_velocity}\n"
         "  - {quantity: projected_gravity}\n  - {quantity: velocity_command}\n"
         "  - {quantity: joint_position}\n  - {quantity: joint_velocity}\n"
         "  - {quantity: last_action}\n  - {quantity: phase_sine}\n  - {quantity: phase_cosine}\n"
         "command: {vx: [-0.2, 0.3], vy: [-0.1, 0.1], wz: [-0.5, 0.5]}\njoints:\n" +
         joints;
}

/** Some robots and the processor time of their rounds. */
class Course {
 public:
  Course(const EnvironmentOptions& options, const std::string& engine)
      : batch_(with_engine(options, engine), kNumRobots, 1, 1),
        rows_(*options.manifest, kNumRobots) {
    batch_.reset(rows_.arrays());
  }

  /** @return Control steps for each second of processor time. */
  double run_round() {
    const double begin = thread_seconds();
    for (int k = 0; k < kStepsOfRound; ++k, ++step_) {
      for (size_t i = 0; i < rows_.actions.size(); ++i) {
        rows_.actions[i] =
            static_cast<float>(kWave * std::sin(0.2 * step_ + 0.7 * static_cast<double>(i)));
      }
      batch_.step(rows_.arrays());
    }
    return kNumRobots * kStepsOfRound / (thread_seconds() - begin);
  }

 private:
  static EnvironmentOptions with_engine(EnvironmentOptions options, const std::string& engine) {
    options.engine = engine;
    return options;
  }

  BatchSimulation batch_;
  BatchRows rows_;
  int step_ = 0;
};

Figure measure(const std::string& model_name, int num_rounds) {
  EnvironmentOptions options;
  options.model = std::make_shared<RobotModel>(RobotModel::find(model_name));
  options.manifest = std::make_shared<PolicyManifest>(
      PolicyManifest::parse(*options.model, manifest_of(*options.model), "benchmark"));
  options.disturbances =
      std::make_shared<sim::DisturbanceSet>(sim::DisturbanceSet::find("default"));
  options.scene = SceneFile::find("empty");
  const std::vector<std::string> engines = sim::engine_names();
  const bool has_mujoco = std::find(engines.begin(), engines.end(), "mujoco") != engines.end();
  Course fast(options, "fast");
  std::unique_ptr<Course> mujoco;
  if (has_mujoco) mujoco = std::make_unique<Course>(options, "mujoco");
  std::vector<double> ours, theirs;
  for (int i = 0; i < num_rounds; ++i) {
    ours.push_back(fast.run_round());
    if (mujoco != nullptr) theirs.push_back(mujoco->run_round());
  }
  Figure figure{"batch." + model_name + "_steps_per_s", median(ours), "1/s of a core", "", 0};
  if (mujoco != nullptr) {
    figure.baseline = "engine mujoco";
    figure.baseline_value = median(theirs);
  }
  return figure;
}

}  // namespace
}  // namespace nao::policy_train

int main(int argc, char** argv) {
  nao::CommandLine app("Measures the simulation of many robots for the training of policies.",
                       "nao-bench-batch");
  int num_rounds = 9;
  app.add_option("--rounds", num_rounds, "Rounds of half a second of simulated time")->positive();
  return nao::run_benchmark(app, argc, argv, [&] {
    std::vector<nao::Figure> figures;
    for (const char* model : {"nao", "t1"}) {
      figures.push_back(nao::policy_train::measure(model, num_rounds));
    }
    return figures;
  });
}
