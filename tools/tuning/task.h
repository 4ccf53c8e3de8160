#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nao {

/** One trial of one candidate of a search, in numbers only: any process that has read the same
 * files can run it. */
struct Task {
  /** Coordinates of the candidate. */
  std::vector<double> point{};
  /** First seed of the candidate's trials. */
  uint64_t seed = 0;
  /** Which of the candidate's trials, from 0. */
  int trial = 0;

  bool operator==(const Task&) const = default;
};

/** Measured values of a trial; the tuner that defines the trials defines their order. */
using Figures = std::vector<double>;

/** Runs a trial. Called from several threads at once; the result depends on the task only. */
using RunTask = std::function<Figures(const Task&)>;

/** Result of a task. */
struct Outcome {
  /** Position of the task in its batch. */
  size_t index = 0;
  Figures figures{};
  /** Processor time of the trial's thread, s. */
  double duration = 0;
  /** Why there are no figures; empty if there are. */
  std::string error{};

  bool operator==(const Outcome&) const = default;
};

}  // namespace nao
