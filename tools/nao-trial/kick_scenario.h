#pragma once

#include "tools/nao-trial/scenario.h"

namespace nao::trial {

/** Kicks a ball; odd seeds with the left foot. With half of the seeds the robot sees the ball, with
 * every fifth one the ball lies beside the kick, which the result of the command must tell. */
class KickScenario : public Scenario {
 public:
  const char* name() const override { return "kick"; }
  const char* summary() const override {
    return "Kick a ball that lies before the left or right foot";
  }
  std::map<std::string, std::string> units() const override {
    return {{"ball_m", "m"},
            {"direction_error_deg", "degrees"},
            {"ball_speed_mps", "m/s"},
            {"told_direction_error_deg", "degrees"},
            {"missed_reported_done", "1"}};
  }
  const char* scene() const override { return "soccer"; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

/** Kicks a ball in passing and walks on. */
class WalkKickScenario : public Scenario {
 public:
  const char* name() const override { return "walk-kick"; }
  const char* summary() const override {
    return "Walk at --vx (0.2 m/s) to a ball, kick it in passing, walk on";
  }
  const char* scene() const override { return "soccer"; }
  std::map<std::string, std::string> units() const override {
    return {{"ball_m", "m"}, {"direction_error_deg", "degrees"}};
  }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;
};

}  // namespace nao::trial
