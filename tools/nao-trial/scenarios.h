#pragma once

#include "tools/nao-trial/scenario.h"

namespace nao::trial {

/** Stands still in StandInit. */
class StandScenario : public Scenario {
 public:
  const char* name() const override { return "stand"; }
  const char* summary() const override { return "Stand still in StandInit for 60 s"; }
  std::map<std::string, std::string> units() const override {
    return {{"drift_mm", "mm"}, {"torso_height_m", "m"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Goes to every posture from every other one. */
class PostureGraphScenario : public Scenario {
 public:
  const char* name() const override { return "posture-graph"; }
  const char* summary() const override { return "Go from every posture to every other one"; }
  std::map<std::string, std::string> units() const override {
    return {{"time_s", "s"}, {"deviation_deg", "degrees"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Gets up after a push, or after being laid down somehow. */
class GetUpScenario : public Scenario {
 public:
  const char* name() const override { return "get-up"; }
  const char* summary() const override { return "Get up after a fall, or from lying anyhow"; }
  std::map<std::string, std::string> units() const override {
    return {{"time_s", "s"},
            {"time_from_belly_s", "s"},
            {"time_from_back_s", "s"},
            {"time_from_side_s", "s"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Stands against pushes, and finds how hard they may be. */
class PushScenario : public Scenario {
 public:
  const char* name() const override { return "push"; }
  const char* summary() const override {
    return "Stand against pushes at the torso, harder and harder, in four directions";
  }
  std::map<std::string, std::string> units() const override {
    return {{"impulse_Ns", "N s"},          {"forward_impulse_Ns", "N s"},
            {"backward_impulse_Ns", "N s"}, {"left_impulse_Ns", "N s"},
            {"right_impulse_Ns", "N s"},    {"warning_ms", "ms"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
  /** Greatest impulse survived in every direction: median and least of the seeds. */
  std::string plot(const Summary& summary) const override;
};

/** Turns random joints by random angles; nothing may tip, hit itself, or jump. */
class JointsScenario : public Scenario {
 public:
  const char* name() const override { return "joints"; }
  const char* summary() const override { return "Obey 100 random joint commands without harm"; }
  std::map<std::string, std::string> units() const override { return {}; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Gets any command in any mode, is pushed over, and loses its mind and gets a new one. */
class CommandsScenario : public Scenario {
 public:
  const char* name() const override { return "commands"; }
  const char* summary() const override {
    return "Answer 100 random commands, in any mode, among pushes and restarts";
  }
  std::map<std::string, std::string> units() const override { return {}; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Walks, poses and turns joints without anybody's push: every alarm of a fall is one too many. */
class AlarmsScenario : public Scenario {
 public:
  const char* name() const override { return "alarms"; }
  const char* summary() const override {
    return "Walk, pose and turn joints for 10 minutes; count alarms of a fall";
  }
  std::map<std::string, std::string> units() const override { return {{"hours", "h"}}; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

}  // namespace nao::trial
