#pragma once

#include "tools/nao-trial/play_scenarios.h"

namespace nao::trial {

/** A match of two teams of two that play by themselves, with a referee: two halves. */
class MatchScenario : public PlayScenario {
 public:
  MatchScenario(bool is_rendered, PerceptionFactory perception);
  std::map<std::string, std::string> units() const override {
    return {{"goals", "1"},         {"outs", "1"},      {"kicks", "1"},          {"falls", "1"},
            {"upright_ratio", "1"}, {"penalties", "1"}, {"longest_stuck_s", "s"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

}  // namespace nao::trial
