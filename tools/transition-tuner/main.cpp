#include <memory>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/program.h"
#include "common/text_file.h"
#include "tools/transition-tuner/get_up_problem.h"
#include "tools/tuning/search_options.h"
#include "tools/tuning/search_run.h"

namespace nao {
namespace {

struct TunerOptions {
  SearchOptions search = {
      .output = "transitions.yaml", .generations = 60, .population = 16, .sigma = 0.04};
  std::string file;
  std::vector<std::string> sequences;
  std::vector<std::string> fixed;
  std::vector<int> keyframes = {0, 1000};
  std::string start = "any";
  int trials = 12;
  bool is_check = false;
};

void tune(const TunerOptions& options) {
  const std::filesystem::path folder = data_path() / "robots" / options.search.model;
  const std::filesystem::path file =
      options.file.empty() ? folder / "transitions.yaml" : std::filesystem::path(options.file);
  GetUpProblemOptions problem_options;
  const auto model = std::make_shared<const RobotModel>(RobotModel::load(folder));
  problem_options.trial.model = model;
  problem_options.trial.scene = SceneFile::find("empty");
  problem_options.start = options.start;
  problem_options.trials = options.trials;
  problem_options.first_keyframe = options.keyframes[0];
  problem_options.last_keyframe = options.keyframes[1];
  problem_options.robot_digest = digest_files(folder, file);
  const GetUpProblem problem(
      problem_options, TrialConditions(options.search.engines, options.search.disturbances),
      TransitionText(*model, read_file(file), options.sequences, options.fixed));
  if (!options.is_check && problem.start().size() < 2) {
    throw ConfigError("--sequence must name a transition with two numbers");
  }
  run_on_workers(options.search, problem, options.is_check);
}

}  // namespace
}  // namespace nao

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Tunes get-up motions: a seeded search over durations and angles of their keyframes, "
      "evaluated in the simulator with disturbances. Rewrites the file of transitions after every "
      "generation; the same seed gives the same search, with any number of threads and, under "
      "mpirun, of processes.",
      "nao-transition-tuner");
  nao::CommonOptions common;
  nao::add_log_option(app, common);
  nao::TunerOptions options;
  nao::add_search_options(app, options.search, "transitions", "rad and s");
  app.add_option("--transitions", options.file, "File to start from (default: the robot's)");
  app.add_option("--sequence", options.sequences, "Transitions to tune, by name");
  app.add_option("--keyframes", options.keyframes, "First and last keyframe to tune, from 0")
      ->count(2);
  app.add_option("--fixed", options.fixed, "Joints, without side, whose angles stay");
  app.add_option("--start", options.start,
                 "Lying pose at the start: any, belly, back, left or right");
  app.add_option("--trials", options.trials,
                 "Trials of each candidate with each engine and set of disturbances")
      ->positive();
  app.add_flag("--check", options.is_check, "Only evaluate the file with --trials trials");
  return nao::run_program(app, common, argc, argv, [&] { nao::tune(options); });
}
