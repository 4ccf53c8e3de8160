#include "tools/nao-trial/scenarios.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/constants.h"
#include "common/error.h"
#include "daemons/motion/actions/kick.h"
#include "kinematics/pose2.h"

namespace nao::trial {
namespace {

// Fraction of the standing height above which the robot stands after a kick.
constexpr double kUprightAfterKick = 0.875;

/** The kick with one foot. */
ActionCommand make_kick(const RobotModel& model, bool is_left, double ball_x, double ball_y) {
  const Action* kick = model.find_action(Action::Kind::kKick, is_left ? Side::kLeft : Side::kRight);
  if (kick == nullptr) throw ConfigError(model.name() + " has no kick");
  return {kick->name, ball_x, ball_y, std::numeric_limits<double>::quiet_NaN()};
}

/** nao-vision, as far as the ball is concerned: where the ball is, with an error, in odometry. */
class SimulatedSight {
 public:
  /** @param trial  Must outlive this. */
  explicit SimulatedSight(ClosedLoop& trial) : trial_(&trial) {}

  /** One control step. */
  void look() {
    constexpr double kPeriod = 1.0 / 15;  // s between images
    constexpr double kSigma = 0.005;      // m, of the filtered ball at the feet
    constexpr double kSigmaPerMetre = 0.02;
    if (trial_->time() - last_ < kPeriod) return;
    last_ = trial_->time();
    const Eigen::Isometry3d odometry_from_world =
        trial_->estimate().torso_in_odometry * trial_->torso_in_world().inverse();
    const Eigen::Vector3d ball = odometry_from_world * trial_->world().ball().position;
    const double distance =
        (trial_->world().ball().position - trial_->torso_in_world().translation()).norm();
    const double error = std::sqrt(12.0) * (kSigma + kSigmaPerMetre * distance) / 2;
    trial_->set_ball(motion::SeenBall{
        trial_->estimate().utime,
        {ball.x() + trial_->random(-error, error), ball.y() + trial_->random(-error, error)}});
  }

 private:
  ClosedLoop* trial_;
  double last_ = -1;
};

/** Degrees that a remark tells; nothing if it tells none. */
std::optional<double> told_direction(const CommandResult& end) {
  if (end.reason.code != "kick-direction") return std::nullopt;
  return std::stod(end.reason.arguments.at(0));
}

std::vector<RunResult> run_kick(const ScenarioOptions& options, uint64_t seed) {
  constexpr double kLeastWay = 2.5;  // m, of the ball
  constexpr double kStartX = -4;     // m, in the world: half a metre before the own goal line
  ClosedLoop trial(options.trial, seed);
  // Far from the goal, whose net would end the ball's way.
  trial.world().place_robot(0, &trial.model().ready_posture(), {kStartX, 0, 0});
  trial.restart_core();
  const bool is_left = seed % 2 == 1;
  // One ball of five lies where the foot does not reach it; half of the robots see the ball.
  const bool is_beside = seed % 5 == 0;
  const bool has_sight = seed / 2 % 2 == 1;
  // The ball is at its best place for the kick: within a centimetre, or farther off where the robot
  // sees it.
  const Eigen::Vector2d best = motion::Kick::load(trial.model().folder() / motion::kKickFile).ball;
  const Eigen::Vector2d seen(best.x(), is_left ? best.y() : -best.y());
  const Eigen::Vector2d range =
      has_sight ? Eigen::Vector2d(0.04, 0.02) : Eigen::Vector2d(0.01, 0.01);
  Eigen::Vector2d ball = seen + Eigen::Vector2d(trial.random(-range.x(), range.x()),
                                                trial.random(-range.y(), range.y()));
  // A ball does not lie in the foot.
  Eigen::AlignedBox2d sole_box;
  for (const Eigen::Vector2d& corner : trial.model().left_sole_outline()) sole_box.extend(corner);
  ball.x() = std::max(ball.x(), sole_box.max().x() + options.trial.scene.ball->radius);
  // Chosen: past the foot's width, and past where the strike ends.
  if (is_beside && trial.random(0, 1) < 0.5)
    ball.x() += trial.random(0.15, 0.4);
  else if (is_beside)
    ball.y() += (is_left ? 1 : -1) * trial.random(0.13, 0.3);
  const auto sole = [&](int link) {
    return Eigen::Vector3d(trial.world().robot(0).link_pose(link).translation());
  };
  const Eigen::Vector3d middle =
      0.5 * (sole(trial.model().left_sole()) + sole(trial.model().right_sole()));
  trial.world().place_ball({middle.x() + ball.x(), middle.y() + ball.y(), 0},
                           Eigen::Vector3d::Zero());
  SimulatedSight sight(trial);
  double speed = 0;
  trial.on_tick([&] {
    if (has_sight) sight.look();
    speed = std::max(speed, trial.world().ball().velocity.norm());
  });
  trial.run(1);
  const Eigen::Vector3d start = trial.world().ball().position;
  // The command does not tell where the ball is: the foot goes to where it is seen, else to the
  // usual place.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const int64_t id = trial.send({"", 0, make_kick(trial.model(), is_left, nan, nan)});
  const auto end = trial.await_end(id, 10);
  // Runs until the ball lies still.
  trial.run_until([&] { return trial.world().ball().velocity.norm() < 0.01; }, 20);
  const Eigen::Vector3d way = trial.world().ball().position - start;
  const bool is_upright =
      trial.torso_tilt() < 0.3 &&
      trial.torso_height() > kUprightAfterKick * trial.model().references().heights.standing;
  RunResult result;
  result.label = std::string(has_sight ? "seen" : "not seen") + (is_beside ? ", beside" : "");
  const double distance = way.head<2>().norm();
  if (distance < 0.1) {
    // A missed ball must not be reported as kicked.
    const bool is_told = end && end->status == ResultStatus::kFailed;
    result.is_success = is_beside && is_upright && is_told;
    if (!is_told)
      result.failure = "missed, and not reported";
    else if (!is_upright)
      result.failure = "fell";
    else if (!is_beside)
      result.failure = "missed";
    const bool is_done =
        end && end->status == ResultStatus::kDone && end->reason.code != "kick-unobserved";
    result.metrics.emplace_back("missed_reported_done", is_done ? 1 : 0);
    return {result};
  }
  result.is_success =
      is_upright && end && end->status == ResultStatus::kDone && distance >= kLeastWay;
  if (!is_upright) {
    result.failure = "fell";
  } else if (!end || end->status != ResultStatus::kDone) {
    result.failure = end ? to_sentence(end->reason) : "did not end";
  } else if (!result.is_success) {
    result.failure = "ball too short";
  }
  const double direction = std::atan2(way.y(), way.x()) / kDegree;
  result.metrics = {{"ball_m", distance},
                    {"ball_speed_mps", speed},
                    {"direction_error_deg", std::abs(direction)}};
  if (const auto told = end ? told_direction(*end) : std::nullopt) {
    result.metrics.emplace_back("told_direction_error_deg", std::abs(*told - direction));
  }
  return {result};
}

std::vector<RunResult> run_walk_kick(const ScenarioOptions& options, uint64_t seed) {
  constexpr double kLeastWay = 0.8;  // m, of the ball
  const double vx = options.velocity.x() > 0 ? options.velocity.x() : 0.2;
  ClosedLoop trial(options.trial, seed);
  const bool is_left = seed % 2 == 1;
  trial.run(1);
  trial.hold_walk({vx, 0, 0});
  trial.run(2 + trial.random(0, 0.5));
  // The ball is somewhere ahead, and seen with an error of a centimetre.
  const Eigen::Vector2d lies(trial.random(0.35, 0.9), trial.random(-0.1, 0.1));
  // The difference between where the ball is and where the command says it is.
  const Eigen::Vector2d seen =
      lies + Eigen::Vector2d(trial.random(-0.01, 0.01), trial.random(-0.01, 0.01));
  const auto sole = [&](int link) { return trial.world().robot(0).link_pose(link); };
  const Eigen::Isometry3d left = sole(trial.model().left_sole());
  const Eigen::Isometry3d right = sole(trial.model().right_sole());
  const Eigen::Isometry3d torso = trial.torso_in_world();
  const double heading = heading_of(torso.linear());
  const Eigen::Vector2d ball = 0.5 * (left.translation() + right.translation()).head<2>() +
                               Eigen::Rotation2Dd(heading) * lies;
  trial.world().place_ball({ball.x(), ball.y(), 0}, Eigen::Vector3d::Zero());
  const Eigen::Vector3d start = trial.world().ball().position;
  const int64_t id = trial.send({"", 0, make_kick(trial.model(), is_left, seen.x(), seen.y())});
  // The claim: the kick happens without a stop of the walk.
  bool walks_on = true;
  trial.on_tick([&] { walks_on = walks_on && trial.core().motion_state().mode == Mode::kWalking; });
  const auto end = trial.await_end(id, 12);
  // It may not walk into the ball again.
  trial.hold_walk({0.05, is_left ? -0.05 : 0.05, 0});
  trial.run(1);
  trial.run_until([&] { return trial.world().ball().velocity.norm() < 0.01; }, 10);
  trial.on_tick({});
  const Eigen::Vector2d way = (trial.world().ball().position - start).head<2>();
  RunResult result;
  if (!end || end->status != ResultStatus::kDone) {
    result.failure = end ? to_sentence(end->reason) : "did not end";
  } else if (!walks_on || trial.torso_tilt() > 0.5) {
    result.failure = "did not walk on";
  } else if (way.norm() < kLeastWay) {
    result.failure = "ball too short";
  } else {
    result.is_success = true;
  }
  result.metrics = {{"ball_m", way.norm()}};
  if (way.norm() > 0.1) {
    const double off = wrapped(std::atan2(way.y(), way.x()) - heading);
    result.metrics.emplace_back("direction_error_deg", std::abs(off) / kDegree);
  }
  return {result};
}

}  // namespace

Scenario kick_scenario() {
  return {"kick",
          "Kick a ball that lies before the left or right foot",
          {{"ball_m", "m"},
           {"direction_error_deg", "degrees"},
           {"ball_speed_mps", "m/s"},
           {"told_direction_error_deg", "degrees"},
           {"missed_reported_done", "1"}},
          run_kick,
          "soccer"};
}

Scenario walk_kick_scenario() {
  return {"walk-kick",
          "Walk at --vx (0.2 m/s) to a ball, kick it in passing, walk on",
          {{"ball_m", "m"}, {"direction_error_deg", "degrees"}},
          run_walk_kick,
          "soccer"};
}

}  // namespace nao::trial
