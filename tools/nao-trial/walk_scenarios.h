#pragma once

#include "tools/nao-trial/scenario.h"

namespace nao::trial {

/** Walks at one velocity, then stands. Fails below half of the velocity. */
class WalkScenario : public Scenario {
 public:
  const char* name() const override { return "walk"; }
  const char* summary() const override {
    return "Walk at --vx --vy --wz for --duration (10 s), then stand";
  }
  std::map<std::string, std::string> units() const override;
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Walks straight ahead at the maximum speed. */
class SprintScenario : public Scenario {
 public:
  const char* name() const override { return "sprint"; }
  const char* summary() const override {
    return "Walk --distance (10 m) ahead at the maximum speed; fails with the torso below 0.20 m";
  }
  std::map<std::string, std::string> units() const override;
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** A joystick session: random starts, stops, reversals, diagonals and turns. */
class JoystickScenario : public Scenario {
 public:
  const char* name() const override { return "joystick"; }
  const char* summary() const override {
    return "Walk with random joystick input for --duration (600 s)";
  }
  std::map<std::string, std::string> units() const override;
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Walks to random poses by odometry. */
class MoveToScenario : public Scenario {
 public:
  const char* name() const override { return "move-to"; }
  const char* summary() const override { return "Move to a random pose up to 2 m away"; }
  std::map<std::string, std::string> units() const override;
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

}  // namespace nao::trial
