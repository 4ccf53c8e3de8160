#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tools/tuning/task.h"

namespace nao {

/** Search problem of a tuner, and its evaluation of a candidate. */
class TuningProblem {
 public:
  virtual ~TuningProblem() = default;

  /** Candidate that the search starts from. */
  virtual Eigen::VectorXd start() const = 0;
  /** Trials of a candidate. */
  virtual int num_trials() const = 0;
  /** Consecutive seeds that the trials of a candidate use. */
  virtual int num_seeds() const = 0;
  /** Runs one trial. Called from several threads at once; depends on the task only. */
  virtual Figures run(const Task& task) const = 0;
  /** Cost of a candidate: finite, smaller is better.
   * @param trials  Its first trials, at least one. */
  virtual double cost(const Eigen::VectorXd& point, const std::vector<Figures>& trials) const = 0;
  /** Words about trials of several candidates: "3 falls in 40 walks". */
  virtual std::string describe(const std::vector<Figures>& trials) const = 0;
  /** Content of the tuner's output for a candidate. */
  virtual std::string text(const Eigen::VectorXd& point) const = 0;
  /** Everything on which the search depends besides the SearchOptions, by name. */
  virtual std::map<std::string, std::string> settings() const = 0;
};

}  // namespace nao
