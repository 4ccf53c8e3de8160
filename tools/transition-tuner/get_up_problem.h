#pragma once

#include <string>
#include <vector>

#include "sim/closed_loop/closed_loop.h"
#include "tools/transition-tuner/get_up_course.h"
#include "tools/transition-tuner/transition_text.h"
#include "tools/tuning/trial_conditions.h"
#include "tools/tuning/tuning_problem.h"

namespace nao {

/** Search problem of the transition tuner. */
struct GetUpProblemOptions {
  /** Model and scene of all trials. */
  ClosedLoopOptions trial;
  /** Lying pose at the start: as parse_start() takes it. */
  std::string start = "any";
  /** Trials of each candidate, for each engine and set of disturbances. */
  int trials = 12;
  /** First and last keyframe whose numbers are searched. */
  int first_keyframe = 0;
  int last_keyframe = 1000;
  /** Digest of the robot's other files, from digest_files(). */
  uint64_t robot_digest = 0;
};

/** Cost of a trial, s: the time, if the robot stood at the end of the first try, plus a little for
 * torque and shaking; otherwise more than any time, and less the higher the torso rose. */
double cost_of(const GetUpResult& result);

/** Search of the numbers of get-up motions. A candidate is a list of these numbers. */
class GetUpProblem : public TuningProblem {
 public:
  /** @param text  Text of the transitions and the numbers in it.
   * @throws ConfigError  if there is no such start. */
  GetUpProblem(GetUpProblemOptions options, TrialConditions conditions, TransitionText text);

  Eigen::VectorXd start() const override;
  int num_trials() const override { return options_.trials * conditions_.count(); }
  int num_seeds() const override { return options_.trials; }
  Figures run(const Task& task) const override;
  double cost(const Eigen::VectorXd& point, const std::vector<Figures>& trials) const override;
  std::string describe(const std::vector<Figures>& trials) const override;
  std::string text(const Eigen::VectorXd& point) const override;
  std::map<std::string, std::string> settings() const override;

 private:
  GetUpProblemOptions options_;
  TrialConditions conditions_;
  GetUpCourse course_;
  TransitionText text_;
  /** All numbers of the text, and which of them are searched. */
  Eigen::VectorXd values_;
  std::vector<long> chosen_;
};

}  // namespace nao
