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

std::vector<RunResult> WalkKickScenario::run(const ScenarioOptions& options, uint64_t seed) const {
  constexpr double kLeastWay = 0.8;  // m, of the ball
  // How far ahead of the torso the ball lies when somebody who sees it says to kick, m.
  constexpr double kAhead = 0.22;
  const double vx = options.velocity.x() > 0 ? options.velocity.x() : 0.2;
  Trial trial(options.trial, seed);
  const bool is_left = seed % 2 == 1;
  const double aside = (is_left ? 0.05 : -0.05) + trial.random(-0.01, 0.01);
  trial.run(1);
  trial.hold_walk({vx, 0, 0});
  trial.run(2.5);
  const auto in_robot = [&](const Eigen::Vector3d& point) {
    const Eigen::Isometry3d torso = trial.torso_in_world();
    const double heading = std::atan2(torso.linear()(1, 0), torso.linear()(0, 0));
    const Eigen::Vector2d way = (point - torso.translation()).head<2>();
    return Eigen::Vector2d(Eigen::Rotation2Dd(-heading) * way);
  };
  const Eigen::Isometry3d torso = trial.torso_in_world();
  const double heading = std::atan2(torso.linear()(1, 0), torso.linear()(0, 0));
  const Eigen::Vector2d ball =
      torso.translation().head<2>() + Eigen::Rotation2Dd(heading) * Eigen::Vector2d(0.6, aside);
  trial.world().place_ball({ball.x(), ball.y(), 0}, Eigen::Vector3d::Zero());
  const Eigen::Vector3d start = trial.world().ball().position;
  trial.run_until([&] { return in_robot(trial.world().ball().position).x() < kAhead; }, 10);
  const int64_t id = trial.send_action(is_left ? "kick-left" : "kick-right");
  const auto end = trial.await_end(id, 3);
  const bool walks_on =
      trial.core().motion_state().mode == motion::Mode::kWalking && trial.torso_tilt() < 0.3;
  // It may not walk into the ball again.
  trial.hold_walk({0.05, is_left ? -0.05 : 0.05, 0});
  trial.run_until([&] { return trial.world().ball().velocity.norm() < 0.01; }, 10);
  const Eigen::Vector2d way = (trial.world().ball().position - start).head<2>();
  RunResult result;
  if (!end || end->status != motion::ResultStatus::kDone) {
    result.failure = end ? end->reason : "did not end";
  } else if (!walks_on || trial.torso_tilt() > 0.5) {
    result.failure = "fell";
  } else if (way.norm() < kLeastWay) {
    result.failure = "ball too short";
  } else {
    result.is_success = true;
  }
  result.metrics = {{"ball_m", way.norm()}};
  if (way.norm() > 0.1) {
    const double off = std::remainder(std::atan2(way.y(), way.x()) - heading, 2 * M_PI);
    result.metrics.emplace_back("direction_error_deg", std::abs(off) * 180 / M_PI);
  }
  return {result};
}

}  // namespace nao::trial
