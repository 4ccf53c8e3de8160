#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/closed_loop/closed_loop.h"
#include "sim/disturbances.h"

namespace nao {

/** Physics engines and disturbances that a tuner evaluates each candidate with: every engine with
 * every set of disturbances. */
class TrialConditions {
 public:
  /** @param disturbances  Names of files, or entries of real with "+" between them.
   * @throws ConfigError  if there is no such engine in this build, or no such disturbance. */
  TrialConditions(const std::vector<std::string>& engines,
                  const std::vector<std::string>& disturbances);

  /** Number of combinations. */
  int count() const { return static_cast<int>(engines_.size() * disturbances_.size()); }
  /** Sets engine and disturbances. @param index  Index of the combination, below count(). */
  void apply(int index, ClosedLoopOptions& options) const;

 private:
  std::vector<std::string> engines_;
  std::vector<std::shared_ptr<const sim::DisturbanceSet>> disturbances_;
};

}  // namespace nao
