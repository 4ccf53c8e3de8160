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

/** Moves from every posture to every other one. */
class PostureGraphScenario : public Scenario {
 public:
  const char* name() const override { return "posture-graph"; }
  const char* summary() const override { return "Go from every posture to every other one"; }
  std::map<std::string, std::string> units() const override {
    return {{"time_s", "s"}, {"deviation_deg", "degrees"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Gets up after a push, or from a random lying pose. */
class GetUpScenario : public Scenario {
 public:
  const char* name() const override { return "get-up"; }
  const char* summary() const override {
    return "Get up after a fall, or from a random lying pose";
  }
  std::map<std::string, std::string> units() const override {
    return {{"time_s", "s"},
            {"time_from_belly_s", "s"},
            {"time_from_back_s", "s"},
            {"time_from_side_s", "s"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Pushes the torso in eight directions: the greatest impulse that the robot withstands standing
 * or, if a velocity is commanded, walking, at the time that is worst for it. */
class PushCourseScenario : public Scenario {
 public:
  const char* name() const override { return "push-course"; }
  const char* summary() const override {
    return "Withstand pushes at the torso in eight directions, standing or at --vx --vy --wz";
  }
  /** Directions are degrees to the left of straight ahead. */
  std::map<std::string, std::string> units() const override;
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
  /** Greatest impulse withstood in every direction: median and minimum of the seeds. */
  std::string plot(const Summary& summary) const override;
};

/** Turns random joints by random angles; the robot must not tip over or collide with itself, and no
 * target may jump. */
class JointsScenario : public Scenario {
 public:
  const char* name() const override { return "joints"; }
  const char* summary() const override {
    return "Execute 100 random joint commands without a fall, self-collision or jump";
  }
  std::map<std::string, std::string> units() const override { return {}; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Sends random commands in every mode, pushes the robot over, and restarts the motion core. */
class CommandsScenario : public Scenario {
 public:
  const char* name() const override { return "commands"; }
  const char* summary() const override {
    return "Answer 100 random commands in any mode, with pushes and restarts of the motion core";
  }
  std::map<std::string, std::string> units() const override { return {}; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Walks, changes postures and turns joints without a push: every fall prediction is a false alarm.
 */
class AlarmsScenario : public Scenario {
 public:
  const char* name() const override { return "alarms"; }
  const char* summary() const override {
    return "Walk, change postures and turn joints for 10 minutes; count false fall predictions";
  }
  std::map<std::string, std::string> units() const override { return {{"hours", "h"}}; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

}  // namespace nao::trial
