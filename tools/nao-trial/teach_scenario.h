#pragma once

#include "tools/nao-trial/scenario.h"

namespace nao::trial {

/** Checks random and hand-made taught motions as nao-motion-files does, plays those that it accepts
 * with other draws of the disturbances, and those that it refuses, too, to count those that were
 * refused without need. */
class TeachScenario : public Scenario {
 public:
  const char* name() const override { return "teach"; }
  const char* summary() const override {
    return "Check and play taught motions: random ones, half of them near postures";
  }
  std::map<std::string, std::string> units() const override { return {{"check_s", "s"}}; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** The same with hand-made motions, seeds 0 to 49: none may be refused. */
class TeachGoodScenario : public TeachScenario {
 public:
  const char* name() const override { return "teach-good"; }
  const char* summary() const override {
    return "Check and play taught motions: hand-made ones, of which none may be refused";
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

}  // namespace nao::trial
