#pragma once

#include <fmt/core.h>

#include <cmath>
#include <functional>

#include "common/random.h"
#include "tools/tuning/tuning_problem.h"

namespace nao {

/** Sphere function with noise in every trial, of which some take much longer than others. */
class NoisyProblem : public TuningProblem {
 public:
  /** Called in every trial. */
  std::function<void(const Task&)> on_trial = [](const Task&) {};

  Eigen::VectorXd start() const override { return Eigen::VectorXd::Ones(5); }
  int num_trials() const override { return 6; }
  int num_seeds() const override { return 6; }
  Figures run(const Task& task) const override {
    on_trial(task);
    Random random(task.seed + static_cast<uint64_t>(task.trial));
    double cost = random.normal() * 0.01;
    for (double x : task.point) cost += x * x;
    // Trials of very different durations, so that threads finish in another order than they start.
    const uint64_t rounds = 1 + random.next() % 20000;
    for (uint64_t i = 0; i < rounds; ++i) random.next();
    return {cost, random.uniform()};
  }
  double cost(const Eigen::VectorXd& /*point*/, const std::vector<Figures>& trials) const override {
    double sum = 0;
    for (const Figures& trial : trials) sum += trial[0];
    return sum / static_cast<double>(trials.size());
  }
  std::string describe(const std::vector<Figures>& trials) const override {
    return fmt::format("{} trials", trials.size());
  }
  std::string text(const Eigen::VectorXd& point) const override {
    std::string text;
    for (double value : point) text += fmt::format("{:a}\n", value);
    return text;
  }
  std::map<std::string, std::string> settings() const override { return {{"noise", "0.01"}}; }
};

}  // namespace nao
