#include "tools/walk-tuner/tune_gait.h"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "common/error.h"
#include "common/text_file.h"
#include "tools/tuning/search_run.h"
#include "tools/walk-tuner/gait_problem.h"

namespace nao::tool {
namespace {

using motion::Gait;

// Parameters that are not tuned unless --only names them. The course does not measure their
// trade-offs: a search would widen bounds, shorten durations and move arms wherever that lowers the
// cost slightly.
const std::vector<std::string> kNotTuned = {
    "timing.start_duration",
    "timing.stop_duration",
    "timing.raise_duration",
    "timing.late_duration",
    "timing.stop_horizon",
    "swing.late_speed",
    "swing.late_depth",
    "stance.turn_center",
    // The robot stands up from a walk into its ready posture: where the feet are not as far apart
    // there as in the walk, they press against the ground and each other.
    "stance.foot_separation",
    "step_limits.max_forward",
    "step_limits.max_backward",
    "step_limits.max_outward",
    "step_limits.min_foot_separation",
    "step_limits.max_turn_outward",
    "step_limits.max_turn_inward",
    "step_limits.square_distance",
    "velocity.max_change_vx",
    "velocity.max_change_vy",
    "velocity.max_change_wz",
    "velocity.envelope_exponent",
    "velocity.max_path_offset",
    "velocity.full_speed_lag",
    "velocity.slow_speed_lag",
    "velocity.slow_speed",
    "velocity.slow_turning",
    "velocity.slow_envelope_exponent",
    "feedback.max_bias",
    "feedback.max_com_offset",
    "standing.ankle_pitch",
    "standing.hip_pitch",
    "standing.least_rate",
    "standing.step_margin",
    "kick.ball_distance",
    "kick.swing_reach",
    "kick.swing_lift",
};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** Applies "GROUP.KEY=NUMBER" settings. @throws ConfigError */
void apply(const std::vector<std::string>& settings, const std::vector<Gait::Parameter>& parameters,
           Gait& gait) {
  for (const std::string& setting : settings) {
    const size_t at = setting.find('=');
    const auto found = std::find_if(
        parameters.begin(), parameters.end(),
        [&](const Gait::Parameter& parameter) { return setting.substr(0, at) == parameter.name; });
    char* end = nullptr;
    const double value = at == std::string::npos ? 0 : std::strtod(setting.c_str() + at + 1, &end);
    if (found == parameters.end() || end == nullptr || *end != 0) {
      throw ConfigError("--set " + setting +
                        " is not GROUP.KEY=NUMBER with a parameter of the gait file");
    }
    found->in(gait) = value;
  }
}

/** Parameters to tune. @throws ConfigError  if there are fewer than two. */
std::vector<Gait::Parameter> choose_tuned(const TunerOptions& options,
                                          const std::vector<Gait::Parameter>& parameters) {
  std::vector<Gait::Parameter> tuned;
  for (const Gait::Parameter& parameter : parameters) {
    const bool is_tuned = options.only.empty() ? !contains(kNotTuned, parameter.name)
                                               : contains(options.only, parameter.name);
    if (is_tuned) tuned.push_back(parameter);
  }
  if (tuned.size() < 2) {
    throw ConfigError("--only must name at least two parameters of the gait file, GROUP.KEY each");
  }
  return tuned;
}

}  // namespace

void tune_gait(const TunerOptions& options) {
  const std::filesystem::path& folder = options.folder;
  const std::filesystem::path file =
      options.gait_file.empty() ? folder / "gait.yaml" : std::filesystem::path(options.gait_file);
  GaitProblemOptions problem_options;
  problem_options.trial.model = std::make_shared<const RobotModel>(RobotModel::load(folder));
  problem_options.trial.scene = SceneFile::find("empty");
  problem_options.trial.missed_tick_probability = options.late_probability;
  problem_options.speed = options.speed;
  problem_options.courses = options.courses;
  problem_options.robot_digest = digest_files(folder, file);
  std::vector<Gait::Parameter> parameters;
  Gait gait = Gait::load(file, &parameters);
  apply(options.settings, parameters, gait);
  const GaitProblem problem(problem_options,
                            TrialConditions(options.search.engines, options.search.disturbances),
                            read_file(file), gait, parameters, choose_tuned(options, parameters));
  run_on_workers(options.search, problem, options.is_check);
}

}  // namespace nao::tool
