#include "nao-trial/kick_scenario.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nao::trial {

std::vector<RunResult> KickScenario::run(const ScenarioOptions& options, uint64_t seed) const {
  constexpr double kLeastWay = 2.5;  // m, of the ball
  Trial trial(options.trial, seed);
  const bool is_left = seed % 2 == 1;
  // Where a robot that sees and walks would have it, a centimetre more or less.
  const Eigen::Vector2d seen(0.18, is_left ? 0.05 : -0.05);
  const Eigen::Vector2d ball =
      seen + Eigen::Vector2d(trial.random(-0.01, 0.01), trial.random(-0.01, 0.01));
  const auto sole = [&](int link) {
    return Eigen::Vector3d(trial.world().robot(0).link_pose(link).translation());
  };
  const Eigen::Vector3d middle =
      0.5 * (sole(trial.model().left_sole()) + sole(trial.model().right_sole()));
  trial.world().place_ball({middle.x() + ball.x(), middle.y() + ball.y(), 0},
                           Eigen::Vector3d::Zero());
  trial.run(1);
  const Eigen::Vector3d start = trial.world().ball().position;
  double speed = 0;
  trial.on_tick([&] { speed = std::max(speed, trial.world().ball().velocity.norm()); });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const int64_t id = trial.send(
      {"", 0, motion::ActionCommand{is_left ? "kick-left" : "kick-right", nan, nan, nan}});
  const auto end = trial.await_end(id, 10);
  // Until the ball lies still.
  trial.run_until([&] { return trial.world().ball().velocity.norm() < 0.01; }, 20);
  const Eigen::Vector3d way = trial.world().ball().position - start;
  const bool is_upright = trial.torso_tilt() < 0.3 && trial.torso_height() > 0.28;
  RunResult result;
  const double distance = way.head<2>().norm();
  result.is_success =
      is_upright && end && end->status == motion::ResultStatus::kDone && distance >= kLeastWay;
  if (!is_upright) {
    result.failure = "fell";
  } else if (!end || end->status != motion::ResultStatus::kDone) {
    result.failure = end ? end->reason : "did not end";
  } else if (!result.is_success) {
    result.failure = "ball too short";
  }
  result.metrics = {{"ball_m", distance}, {"ball_speed_mps", speed}};
  if (distance > 0.1) {
    result.metrics.emplace_back("direction_error_deg",
                                std::abs(std::atan2(way.y(), way.x())) * 180 / M_PI);
  }
  return {result};
}

}  // namespace nao::trial
