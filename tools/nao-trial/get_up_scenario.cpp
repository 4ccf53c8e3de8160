#include <algorithm>
#include <cmath>

#include "nao-trial/scenarios.h"

namespace nao::trial {
namespace {

constexpr double kTimeout = 60;  // s, six tries and the waiting between
constexpr int kMaxTries = 3;
constexpr double kStillVelocity = 0.1;  // rad/s

/** Knocks the standing robot over. */
void knock_over(Trial& trial) {
  trial.run(1.0 + trial.random(0, 0.5));
  const double direction = trial.random(-M_PI, M_PI);
  const double impulse = trial.random(4, 6);
  trial.world().push(0, 0, {impulse * std::cos(direction), impulse * std::sin(direction), 0});
  trial.run_until([&] { return trial.torso_tilt() > 1.0; }, 5);
}

/** Lays the robot down with random joints, on any side. */
void lay_down(Trial& trial) {
  Posture posture = *trial.model().find_posture("StandInit");
  for (int motor = 0; motor < trial.model().num_motors(); ++motor) {
    const Joint& joint = trial.model().motor_joint(motor);
    const double wished = posture.position[motor] + trial.random(-0.5, 0.5);
    posture.position[motor] = std::min(std::max(wished, joint.lower), joint.upper);
  }
  const double side = trial.random(-M_PI, M_PI);
  const Eigen::Quaterniond orientation = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()) *
                                         Eigen::AngleAxisd(side, Eigen::Vector3d::UnitZ());
  trial.world().place_robot(0, &posture, {0, 0, 0.01}, &orientation);
}

}  // namespace

std::vector<RunResult> GetUpScenario::run(const ScenarioOptions& options, uint64_t seed) const {
  Trial trial(options.trial, seed);
  RunResult result;
  const bool falls = seed % 2 == 1;
  result.label = falls ? "pushed" : "laid down";
  trial.run(0.5);
  if (falls) {
    knock_over(trial);
  } else {
    lay_down(trial);
  }
  if (falls && trial.torso_tilt() < 1.0) {
    result.failure = "did not fall";
    return {result};
  }
  // From lying still on.
  Eigen::Vector3d up = trial.torso_in_world().linear().row(2);
  trial.run_until(
      [&] {
        const Eigen::Vector3d now = trial.torso_in_world().linear().row(2);
        const double turned = (now - up).norm();
        up = now;
        return turned / 0.01 < kStillVelocity;
      },
      3);
  const char* side = std::abs(up.x()) > std::abs(up.y()) ? (up.x() < 0 ? "belly" : "back") : "side";
  result.label += std::string(", ") + side;
  const double start = trial.time();
  int num_tries = 0;
  trial.on_tick([&] { num_tries = std::max(num_tries, trial.core().motion_state().num_tries); });
  const bool is_up = trial.run_until(
      [&] {
        return trial.core().motion_state().posture == "StandInit" && trial.torso_tilt() < 0.3 &&
               trial.torso_height() > 0.29;
      },
      kTimeout);
  result.metrics.emplace_back("tries", num_tries);
  if (!is_up) {
    result.failure = "still down";
    return {result};
  }
  result.metrics.emplace_back("time_s", trial.time() - start);
  result.metrics.emplace_back(std::string("time_from_") + side + "_s", trial.time() - start);
  result.is_success = num_tries <= kMaxTries;
  if (!result.is_success) result.failure = "more than 3 tries";
  return {result};
}

}  // namespace nao::trial
