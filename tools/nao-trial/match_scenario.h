#pragma once

#include "tools/nao-trial/scenario.h"

namespace nao::trial {

/** A match of two teams that play by themselves, with a referee: two halves. Perception is
 * PerceptionModel, no rendering. */
class MatchScenario : public Scenario {
 public:
  const char* name() const override { return "match"; }
  const char* summary() const override {
    return "Two robots play against two, by themselves, for five minutes; perception is an error "
           "model, no rendering";
  }
  const char* scene() const override { return "soccer"; }
  std::map<std::string, std::string> units() const override {
    return {{"goals", "1"},         {"outs", "1"},      {"kicks", "1"},          {"falls", "1"},
            {"upright_ratio", "1"}, {"penalties", "1"}, {"longest_stuck_s", "s"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

}  // namespace nao::trial
