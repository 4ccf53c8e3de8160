#pragma once

#include "tools/nao-trial/scenario.h"

namespace nao::trial {

/** A goalkeeper: blocks, or dives to one side and gets up. */
class BlockScenario : public Scenario {
 public:
  const char* name() const override { return "block"; }
  const char* summary() const override {
    return "Block, dive left and dive right; stand again afterwards";
  }
  std::map<std::string, std::string> units() const override {
    return {{"block_s", "s"},
            {"block_width_m", "m"},
            {"dive_s", "s"},
            {"dive_reach_m", "m"},
            {"stand_again_s", "s"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

}  // namespace nao::trial
