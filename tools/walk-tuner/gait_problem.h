#pragma once

#include <string>
#include <vector>

#include "daemons/motion/walk/gait.h"
#include "sim/closed_loop/closed_loop.h"
#include "tools/tuning/trial_conditions.h"
#include "tools/tuning/tuning_problem.h"
#include "tools/walk-tuner/walk_course.h"

namespace nao::tool {

/** Search problem of the walk tuner. */
struct GaitProblemOptions {
  /** Model, scene and late ticks of all walks. */
  ClosedLoopOptions trial;
  /** Fraction of the model's walk limits that is commanded. */
  double speed = 1;
  /** Courses of each candidate, for each engine and set of disturbances. */
  int courses = 1;
  /** Digest of the robot's other files, from digest_files(). */
  uint64_t robot_digest = 0;
};

/** Search of a gait's parameters. A candidate is a point of the unit cube of their ranges; a trial
 * is one walk of a course. */
class GaitProblem : public TuningProblem {
 public:
  /** @param text        Text of the gait file that the search starts from.
   * @param start       Its gait, with other values where the command line sets them.
   * @param parameters  All parameters of the file. @param tuned       Parameters that are searched.
   */
  GaitProblem(GaitProblemOptions options, TrialConditions conditions, std::string text,
              const motion::Gait& start, std::vector<motion::Gait::Parameter> parameters,
              std::vector<motion::Gait::Parameter> tuned);

  Eigen::VectorXd start() const override;
  int num_trials() const override {
    return options_.courses * conditions_.count() * WalkCourse::kNumWalks;
  }
  int num_seeds() const override { return options_.courses; }
  Figures run(const Task& task) const override;
  double cost(const Eigen::VectorXd& point, const std::vector<Figures>& trials) const override;
  std::string describe(const std::vector<Figures>& trials) const override;
  std::string text(const Eigen::VectorXd& point) const override;
  std::map<std::string, std::string> settings() const override;

 private:
  /** Coordinates outside the cube are clamped. */
  motion::Gait gait_at(const Eigen::VectorXd& point) const;

  GaitProblemOptions options_;
  TrialConditions conditions_;
  WalkCourse course_;
  std::string text_;
  motion::Gait start_;
  std::vector<motion::Gait::Parameter> parameters_;
  std::vector<motion::Gait::Parameter> tuned_;
};

}  // namespace nao::tool
