#include "daemons/play/ball_search.h"

#include <algorithm>
#include <cmath>

#include "daemons/play/approach.h"

namespace nao::play {
namespace {

/** Directions of the scan, rad to the left: with a field of view of 1.06 rad they leave no gap. */
constexpr double kScanBearings[] = {0, 0.85, -0.85};
/** Places to which the robot walks, as fractions of half the field's length and width, in its own
 * half and just beyond its line. */
constexpr double kPlaces[][2] = {{-0.35, 0}, {0.2, 0.3}, {-0.6, 0.4}, {-0.6, -0.4}, {0.2, -0.3}};

}  // namespace

void BallSearch::start(const std::optional<Eigen::Vector2d>& last, const Situation& situation) {
  *this = {};
  is_active_ = true;
  start_ = situation.time;
  last_ = last;
  if (last) {
    const Eigen::Vector2d ball = situation.robot.feet_in_odometry.inverse() * *last;
    direction_ = ball.y() < 0 ? -1 : 1;
  }
  enter(Stage::kScan, situation);
}

void BallSearch::enter(Stage stage, const Situation& situation) {
  stage_ = stage;
  stage_start_ = situation.time;
  turned_ = 0;
  heading_ = situation.robot.feet_in_odometry.heading;
}

Decision BallSearch::step(const Situation& situation, const PlayConstants& constants) {
  const PlayParameters::BallSearch& parameters = constants.parameters.ball_search;
  Decision decision;
  decision.phase = PlayPhase::kSearch;
  decision.reason = Reason("ball-not-in-sight");
  decision.gaze.depression = parameters.scan_depression;
  switch (stage_) {
    case Stage::kScan:
      scan(situation, parameters, decision);
      break;
    case Stage::kTurn:
      turn(situation, constants, decision);
      break;
    case Stage::kRoam:
      roam(situation, constants, decision);
      break;
  }
  return decision;
}

void BallSearch::scan(const Situation& situation, const PlayParameters::BallSearch& parameters,
                      Decision& decision) {
  int index = static_cast<int>((situation.time - stage_start_) / parameters.dwell);
  if (last_) {
    decision.gaze.point = last_;
    if (index == 0) return;
    decision.gaze.point.reset();
    --index;
  }
  const size_t num_cameras = situation.robot.cameras.size();
  // The cameras are used in turn: the lower ones straight ahead, then the first one in all
  // directions.
  if (index + 1 < static_cast<int>(num_cameras)) {
    decision.gaze.camera = static_cast<size_t>(index) + 1;
    decision.gaze.depression += 0.6;
    return;
  }
  index -= std::max(0, static_cast<int>(num_cameras) - 1);
  if (index < static_cast<int>(std::size(kScanBearings))) {
    decision.gaze.bearing = direction_ * kScanBearings[index];
    return;
  }
  enter(Stage::kTurn, situation);
}

void BallSearch::turn(const Situation& situation, const PlayConstants& constants,
                      Decision& decision) {
  const PlayParameters::BallSearch& parameters = constants.parameters.ball_search;
  const double heading = situation.robot.feet_in_odometry.heading;
  turned_ += wrapped(heading - heading_);
  heading_ = heading;
  decision.walk.wz = direction_ * std::min(parameters.turn_rate, constants.walk_limits.turning);
  // The cameras are used in turn, for far and near objects.
  const auto cycle = static_cast<size_t>((situation.time - stage_start_) / parameters.dwell);
  const bool looks_down = cycle % 4 == 3 && situation.robot.cameras.size() > 1;
  decision.gaze.camera = looks_down ? 1 : 0;
  if (looks_down) decision.gaze.depression += 0.6;
  if (std::abs(turned_) < 2 * M_PI) return;
  enter(Stage::kRoam, situation);
  ++num_roams_;
}

void BallSearch::roam(const Situation& situation, const PlayConstants& constants,
                      Decision& decision) {
  const PlayParameters::BallSearch& parameters = constants.parameters.ball_search;
  const double* place = kPlaces[static_cast<size_t>(num_roams_ - 1) % std::size(kPlaces)];
  const Eigen::Vector2d in_field(0.5 * constants.field.length * place[0],
                                 0.5 * constants.field.width * place[1]);
  const Pose2& feet = situation.robot.feet_in_odometry;
  const Eigen::Vector2d goal = situation.field_in_odometry * in_field;
  decision.target = goal;
  decision.walk = plan_walk_to({goal, feet.heading}, feet, constants);
  // While it walks, the robot looks from side to side.
  decision.gaze.bearing = 0.7 * std::sin(2 * (situation.time - stage_start_));
  const bool is_there = (goal - feet.position).norm() < parameters.reached;
  if (is_there || situation.time - stage_start_ > parameters.roam_time)
    enter(Stage::kScan, situation);
}

}  // namespace nao::play
