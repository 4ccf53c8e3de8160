#pragma once

#include <string>

#include "tools/nao-trial/scenario.h"
#include "tools/nao-trial/trial_perception.h"

namespace nao::trial {

/** A scenario of nao-play's behaviors with one kind of perception. A perception without rendered
 * images is named in the scenario's name and summary. */
class PlayScenario : public Scenario {
 public:
  PlayScenario(const std::string& name, const std::string& summary, bool is_rendered,
               PerceptionFactory perception);

  const char* name() const override { return name_.c_str(); }
  const char* summary() const override { return summary_.c_str(); }
  const char* scene() const override { return "soccer"; }

 protected:
  PerceptionFactory perception_;

 private:
  std::string name_;
  std::string summary_;
};

/** Scores, with ball and robot anywhere in the robot's own half. */
class ScoreScenario : public PlayScenario {
 public:
  ScoreScenario(bool is_rendered, PerceptionFactory perception);
  std::map<std::string, std::string> units() const override {
    return {{"time_s", "s"}, {"kicks", "1"}, {"falls", "1"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Keeps the goal against one shot. */
class KeepGoalScenario : public PlayScenario {
 public:
  KeepGoalScenario(bool is_rendered, PerceptionFactory perception);
  std::map<std::string, std::string> units() const override {
    return {{"time_s", "s"}, {"shot_mps", "m/s"}, {"aside_m", "m"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** PerceptionModel with its usual errors. */
PerceptionFactory perception_model();

}  // namespace nao::trial
