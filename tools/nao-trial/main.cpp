#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/error.h"
#include "common/output_file.h"
#include "common/program.h"
#include "sim/closed_loop/calibrate.h"
#include "tools/nao-trial/scenarios.h"
#include "tools/nao-trial/statistics.h"

namespace nao::trial {
namespace {

/** Reads "A-B" or "A". @throws ConfigError */
std::vector<uint64_t> parse_seeds(const std::string& text) {
  unsigned long first = 0;
  unsigned long last = 0;
  char rest = 0;
  // %c matches only if something follows the number: "1-10x" is not a range.
  const int num_read = std::sscanf(text.c_str(), "%lu-%lu%c", &first, &last, &rest);
  if (num_read == 1 && text.find_first_not_of("0123456789") == std::string::npos) last = first;
  const bool is_range = num_read == 2 && last >= first && last - first < 1000000;
  if (!is_range && !(num_read == 1 && last == first)) {
    throw ConfigError("--seeds " + text + " is not a range A-B with A <= B, such as 1-100");
  }
  std::vector<uint64_t> seeds;
  for (uint64_t seed = first; seed <= last; ++seed) seeds.push_back(seed);
  return seeds;
}

void print(const RunResult& run, uint64_t seed) {
  std::printf("seed %lu %s: %s", static_cast<unsigned long>(seed), run.label.c_str(),
              run.is_success ? "ok" : run.failure.c_str());
  for (const auto& [name, value] : run.metrics) std::printf("  %s %.4g", name.c_str(), value);
  std::printf("\n");
  std::fflush(stdout);
}

std::vector<RunResult> run_seed(const Scenario& scenario, const ScenarioOptions& options,
                                uint64_t seed) {
  ScenarioOptions robot = options;
  // Each robot is calibrated under its own disturbances before its run.
  if (options.num_calibration_directions > 0) {
    robot.trial.motion.calibration =
        calibrate(options.trial, seed, options.num_calibration_directions);
  }
  return scenario.run(robot, seed);
}

/** @param num_jobs  Number of seeds that run at the same time, which changes no result. */
Summary run_all(const Scenario& scenario, const ScenarioOptions& options,
                const std::vector<uint64_t>& seeds, int num_jobs, bool is_verbose) {
  std::vector<std::vector<RunResult>> runs(seeds.size());
  std::atomic<size_t> next{0};
  std::mutex printing;
  const auto work = [&] {
    for (size_t i = next++; i < seeds.size(); i = next++) {
      runs[i] = run_seed(scenario, options, seeds[i]);
      if (!is_verbose) continue;
      const std::lock_guard lock(printing);
      for (const RunResult& run : runs[i]) print(run, seeds[i]);
    }
  };
  std::vector<std::future<void>> others;
  for (int job = 1; job < num_jobs; ++job) {
    others.push_back(std::async(std::launch::async, work));
  }
  work();
  for (std::future<void>& other : others) other.get();
  Summary summary;
  summary.scenario = scenario.name;
  summary.units = scenario.units;
  for (size_t i = 0; i < seeds.size(); ++i) {
    for (RunResult& run : runs[i]) {
      summary.runs.push_back(std::move(run));
      // One entry for each run: a scenario may have several for a seed.
      summary.seeds.push_back(seeds[i]);
    }
  }
  return summary;
}

/** Robots of each team. @param text  Such as "2v2". @throws Error */
std::array<int, 2> parse_teams(const std::string& text) {
  const auto is_size = [](char digit) { return '1' <= digit && digit <= '5'; };
  if (text.size() != 3 || !is_size(text[0]) || text[1] != 'v' || !is_size(text[2])) {
    throw Error("--teams: '" + text + "' is not two teams of 1 to 5 robots, such as 2v2");
  }
  return {text[0] - '0', text[2] - '0'};
}

}  // namespace
}  // namespace nao::trial

int main(int argc, char** argv) {
  using namespace nao::trial;
  nao::CommandLine app(
      "Runs seeded trials of simulator and motion core in one process, in lock-step, without a "
      "bus.",
      "nao-trial");
  nao::CommonOptions common;
  nao::add_log_option(app, common);
  app.require_subcommand();
  std::string seeds = "1-10";
  std::string json_file;
  std::string plot_file;
  std::string model_name = "nao";
  bool is_verbose = false;
  int num_jobs = 1;
  std::string teams = "2v2";
  std::string disturbances = "default";
  ScenarioOptions options;
  const Scenario* chosen = nullptr;
  std::vector<Scenario> all = scenarios();
#ifdef NAO_TRIAL_HAS_VISION
  for (const Scenario& scenario : vision_scenarios()) all.push_back(scenario);
#endif
  for (const Scenario& scenario : all) {
    nao::CommandLine* command = app.add_subcommand(scenario.name, scenario.summary);
    command->add_option("--seeds", seeds, "First and last seed, one run each");
    command->add_option("--jobs", num_jobs, "Seeds that run at the same time, each in a thread")
        ->range(1, 64);
    command->add_option("--json", json_file, "Write the summary to this file too");
    command->add_option("--plot", plot_file, "Draw the results to this SVG file (push-course)");
    nao::add_model_option(*command, model_name);
    command->add_option("--duration", options.duration,
                        "Duration of a run, s (0: the scenario's default)");
    command->add_option("--vx", options.velocity.x(), "Commanded velocity ahead, m/s");
    command->add_option("--vy", options.velocity.y(), "To the left, m/s");
    command->add_option("--wz", options.velocity.z(), "Turning to the left, rad/s");
    command->add_option("--teams", teams, "match: robots of the two teams, 1 to 5 each");
    command->add_option("--distance", options.distance, "Distance, m (0: the scenario's default)");
    command->add_option("--late", options.trial.missed_tick_probability,
                        "Probability in each tick that motion misses it and up to three more");
    command
        ->add_option(
            "--latency", options.trial.command_latency_ticks,
            "Control ticks from a joint command to the motors (0: as the disturbances say)")
        ->range(0, 10);
    command->add_option(
        "--trace", options.trace_file,
        "walk, score, keep-goal, match: write what was true and what was known in the last seed "
        "to this file, CSV");
    command->add_option("--engine", options.trial.engine,
                        "Physics engine: fast, simbody, or mujoco where it was built");
    command->add_option(
        "--disturbances", disturbances,
        "Disturbances to draw for each seed: none, default, moderate, real, or entries of "
        "real such as backlash,floor_slope");
    command
        ->add_option("--calibrate", options.num_calibration_directions,
                     "Calibrate each robot before its run, standing in so many directions (0: not)")
        ->range(0, 8);
    command->add_option(
        "--policy", options.trial.motion.policy,
        "Policy that walks or gets up: a folder in policies/ of the robot; none: get-ups are "
        "model-based");
    command->add_flag("--ideal", options.trial.is_ideal,
                      "No noise or latency either: --disturbances none");
    command->add_flag("--verbose", is_verbose, "Print a line for each run");
    command->on_parsed([&chosen, &scenario] { chosen = &scenario; });
  }
  return nao::run_program(app, common, argc, argv, [&] {
    const Scenario& scenario = *chosen;
    options.trial.model = std::make_shared<nao::RobotModel>(nao::RobotModel::find(model_name));
    if (options.trial.is_ideal) disturbances = "none";
    options.trial.disturbances =
        std::make_shared<nao::sim::DisturbanceSet>(nao::sim::DisturbanceSet::find(disturbances));
    options.trial.scene = nao::SceneFile::find(scenario.scene);
    options.team_sizes = parse_teams(teams);
    options.is_for_plot = !plot_file.empty();
    if (num_jobs > 1 && !options.trace_file.empty()) {
      throw nao::ConfigError("--trace writes the last seed's run: use it with --jobs 1");
    }
    Summary summary = run_all(scenario, options, parse_seeds(seeds), num_jobs, is_verbose);
    summary.engine = options.trial.engine;
    summary.disturbances = disturbances;
    summary.model = model_name;
    std::fputs(to_table(summary).c_str(), stdout);
    if (!json_file.empty()) nao::replace_file(json_file, to_json(summary));
    if (!plot_file.empty()) {
      if (!scenario.plot) throw nao::Error(scenario.name + " has no plot; omit --plot");
      nao::replace_file(plot_file, scenario.plot(summary));
    }
  });
}
