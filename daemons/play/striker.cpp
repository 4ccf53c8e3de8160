#include "daemons/play/striker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "daemons/play/ball_in_walk.h"
#include "daemons/play/rolling_ball.h"

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Age of an image when its contents are known, s. */
constexpr double kImageAge = 0.1;

}  // namespace

void Striker::restart() {
  stage_ = Stage::kApproach;
  still_since_.reset();
  search_.stop();
}

Decision Striker::step(const Situation& situation) {
  memory_.take(situation.ball, situation.robot.feet_in_odometry);
  if (situation.ended) handle_end(*situation.ended, situation);
  if (situation.is_performing) {
    Decision decision;
    decision.phase = PlayPhase::kKick;
    decision.target = calc_aim(kicked_ball_, situation).target;
    decision.gaze.point = kicked_ball_;
    return decision;
  }
  std::optional<Ball> ball = find_ball(situation);
  if (!memory_.is_confirmed()) {
    const bool is_looked_at = ball && memory_.is_candidate(situation.time);
    if (is_looked_at && stage_ != Stage::kWatch) return look_at_candidate(*ball);
    ball.reset();
  }
  if (stage_ == Stage::kWatch) {
    const bool is_over = situation.time - stage_start_ > parameters_.watch_time;
    if (task_ == Task::kKick || (!is_over && !ball)) return watch(situation);
    stage_ = Stage::kApproach;
  }
  if (!ball) {
    stage_ = Stage::kApproach;
    return look_for_ball(situation);
  }
  search_.stop();
  // If the ball is out of sight again, as after a kick, the robot searches where it rolls to.
  const Vector2d way = ball->position - situation.robot.feet_in_odometry.position;
  expected_.reset();
  if (way.norm() > parameters_.landmark_distance)
    expected_ = into_field(ball->position, 0, situation);
  if (auto end = find_end(*ball, situation)) return *end;
  switch (stage_) {
    case Stage::kSettle:
      return settle(*ball, situation);
    case Stage::kPush:
      return push(*ball, situation);
    default:
      return approach(*ball, situation);
  }
}

void Striker::handle_end(const CommandResult& result, const Situation& situation) {
  stage_start_ = situation.time;
  still_since_.reset();
  if (result.status != ResultStatus::kDone) {
    // The kick was refused or failed: the ball has moved, or the robot stood badly.
    stage_ = Stage::kApproach;
    return;
  }
  // A robot that walks on does not stop to watch.
  stage_ = is_passing_ ? Stage::kApproach : Stage::kWatch;
  num_settles_ = 0;
  side_ = 0;
  ignore_before_ = is_passing_ ? situation.time - kImageAge : kick_start_ + parameters_.strike_time;
  expected_ = kicked_ball_ + (is_passing_ ? parameters_.passing_kick_distance
                                          : constants_.parameters.shot_aim.kick_distance) *
                                 Vector2d(std::cos(kick_heading_), std::sin(kick_heading_));
  // It does not leave the goal again.
  expected_ = into_field(*expected_, -0.5 * constants_.field.goal_depth, situation);
}

Vector2d Striker::into_field(const Vector2d& point, double margin,
                             const Situation& situation) const {
  const Field& field = constants_.field;
  const Vector2d most(0.5 * field.length - margin, 0.5 * field.width - std::max(0.0, margin));
  const Vector2d in_field = situation.field_in_odometry.inverse() * point;
  return situation.field_in_odometry * in_field.cwiseMax(-most).cwiseMin(most);
}

std::optional<Ball> Striker::find_ball(const Situation& situation) const {
  if (!situation.ball || situation.ball->seen_time < ignore_before_) return std::nullopt;
  Ball ball = *situation.ball;
  const double distance = (ball.position - situation.robot.feet_in_odometry.position).norm();
  const double age = situation.time - ball.seen_time;
  if (age >
      (distance < parameters_.near ? parameters_.forget_after_near : parameters_.forget_after))
    return std::nullopt;
  ball.position =
      predict_rest(ball, situation.robot.feet_in_odometry.position, constants_.parameters);
  return ball;
}

Aim Striker::calc_aim(const Vector2d& ball, const Situation& situation) const {
  const Vector2d& feet = situation.robot.feet_in_odometry.position;
  Aim aim;
  if (task_ == Task::kGoToBall) {
    const Vector2d way = ball - feet;
    aim = {std::atan2(way.y(), way.x()), constants_.parameters.shot_aim.greatest_tolerance, ball};
  } else if (target_) {
    const Vector2d way = *target_ - ball;
    aim = {std::atan2(way.y(), way.x()), constants_.parameters.shot_aim.least_tolerance, *target_};
  } else {
    aim = aim_past_robots(aim_at_goal(ball, situation, constants_), ball, situation, constants_);
  }
  // A robot that several times could not stop accurately enough accepts a larger error.
  aim.tolerance = std::min(constants_.parameters.shot_aim.greatest_tolerance,
                           aim.tolerance + 0.04 * std::max(0, num_settles_ - 2));
  return aim;
}

ApproachGoal Striker::make_goal(const Vector2d& ball, const Aim& aim, const Pose2& feet) {
  if (task_ == Task::kGoToBall) return {ball, aim.heading, {parameters_.before_ball, 0}};
  const Vector2d place =
      constants_.kick ? constants_.kick->ball : Vector2d(parameters_.before_ball, 0);
  // Chooses the foot on the ball's side: the left one if the ball is to the left. It has a
  // hysteresis, m, and does not change near the ball.
  const Pose2 ball_in_odometry{ball, aim.heading};
  const Vector2d from_ball = ball_in_odometry.inverse() * feet.position;
  const bool may_change = from_ball.norm() > 0.4 && std::abs(from_ball.y()) > 0.1;
  if (side_ == 0 || may_change) side_ = from_ball.y() > 0 ? -1 : 1;
  return {ball, aim.heading, {place.x(), side_ * place.y()}};
}

std::optional<Decision> Striker::find_end(const Ball& ball, const Situation& situation) const {
  Decision decision;
  decision.gaze.point = ball.position;
  decision.phase = PlayPhase::kDone;
  decision.is_done = true;
  const Field& field = constants_.field;
  const Vector2d seen = situation.field_in_odometry.inverse() * situation.ball->position;
  const double distance = (ball.position - situation.robot.feet_in_odometry.position).norm();
  if (task_ == Task::kScore) {
    if (distance > parameters_.judge_distance) return std::nullopt;
    const double tilt_error =
        parameters_.tilt_error *
        (distance * distance + parameters_.camera_height * parameters_.camera_height) /
        parameters_.camera_height;
    const bool is_behind_line =
        seen.x() > 0.5 * field.length + parameters_.behind_line + tilt_error;
    const double opening = 0.5 * field.goal_width + 0.1;
    if (is_behind_line && std::abs(seen.y()) < opening) return decision;
    const bool is_beside =
        is_behind_line ||
        std::abs(seen.y()) > 0.5 * field.width + std::max(parameters_.target_reached,
                                                          parameters_.behind_line + tilt_error);
    if (!is_beside || ball.is_rolling) return std::nullopt;
    decision.has_failed = true;
    decision.reason = Reason("ball-out");
    return decision;
  }
  if (task_ == Task::kDribble && target_ && !ball.is_rolling &&
      (ball.position - *target_).norm() < parameters_.target_reached) {
    return decision;
  }
  return std::nullopt;
}

// A standing robot does not see a false ball again.
Decision Striker::look_at_candidate(const Ball& ball) {
  Decision decision;
  decision.phase = PlayPhase::kSearch;
  decision.reason = Reason("ball-not-in-sight");
  decision.gaze.point = ball.position;
  return decision;
}

Decision Striker::look_for_ball(const Situation& situation) {
  const Pose2& feet = situation.robot.feet_in_odometry;
  if (expected_) {
    if ((*expected_ - feet.position).norm() > 1.0) {
      Decision decision;
      decision.phase = PlayPhase::kSearch;
      decision.reason = Reason("ball-not-in-sight");
      decision.target = expected_;
      const Vector2d way = *expected_ - feet.position;
      decision.walk = plan_walk_to({*expected_, std::atan2(way.y(), way.x())}, feet, constants_);
      decision.gaze.point = expected_;
      return decision;
    }
    search_.start(expected_, situation);
    expected_.reset();
  }
  if (!search_.is_active()) {
    std::optional<Vector2d> last;
    if (situation.ball && situation.ball->seen_time >= ignore_before_) {
      last = situation.ball->position;
    }
    search_.start(last, situation);
  }
  Decision decision = search_.step(situation, constants_);
  if (search_.duration(situation) > parameters_.search_timeout) {
    decision = {};
    decision.phase = PlayPhase::kDone;
    decision.is_done = true;
    decision.has_failed = true;
    decision.reason = Reason("ball-not-found", {to_argument(parameters_.search_timeout)});
  }
  return decision;
}

void Striker::look_at(const Ball& ball, const Situation& situation, Decision& decision) const {
  const Pose2& feet = situation.robot.feet_in_odometry;
  const double distance = (ball.position - feet.position).norm();
  const bool looks_around =
      distance > parameters_.landmark_distance && situation.time - situation.ball->seen_time < 1 &&
      std::fmod(situation.time, parameters_.landmark_period) < parameters_.landmark_time;
  if (!looks_around) {
    decision.gaze.point = ball.position;
    return;
  }
  decision.gaze.depression = parameters_.landmark_depression;
}

Decision Striker::approach(const Ball& ball, const Situation& situation) {
  const Pose2& feet = situation.robot.feet_in_odometry;
  const Aim aim = calc_aim(ball.position, situation);
  const ApproachGoal goal = make_goal(ball.position, aim, feet);
  const Pose2 error = calc_approach_error(goal, feet);
  const double distance = (ball.position - feet.position).norm();
  Decision decision;
  decision.phase = distance < parameters_.near ? PlayPhase::kAlign : PlayPhase::kApproach;
  decision.target = task_ == Task::kGoToBall ? ball.position : aim.target;
  look_at(ball, situation, decision);
  decision.walk = plan_approach(goal, feet, constants_);
  if (auto passing = kick_in_passing(ball, aim, situation)) return *passing;
  if (kicks_in_passing_ && task_ == Task::kScore && can_carry(ball, aim, situation, constants_)) {
    stage_ = Stage::kPush;
    return push(ball, situation);
  }
  const bool is_before_ball = task_ == Task::kGoToBall && distance < parameters_.before_ball + 0.08;
  const Vector2d reach = parameters_.stop_fraction *
                         (constants_.kick ? constants_.kick->reach : Vector2d(0.05, 0.025));
  // Position of the ball seen from the feet, used even if the aim is met only roughly.
  const Vector2d off = (feet.inverse() * ball.position - goal.ball_in_feet).cwiseAbs();
  const bool is_in_place =
      off.x() < reach.x() && off.y() < reach.y() && std::abs(error.heading) < 0.8 * aim.tolerance;
  if (!is_before_ball && !is_in_place) return decision;
  stage_start_ = situation.time;
  still_since_.reset();
  if (task_ == Task::kDribble) {
    stage_ = Stage::kPush;
    return push(ball, situation);
  }
  stage_ = Stage::kSettle;
  settled_aim_ = aim;
  return settle(ball, situation);
}

std::optional<Decision> Striker::kick_in_passing(const Ball& ball, const Aim& aim,
                                                 const Situation& situation) {
  if (!kicks_in_passing_ || !constants_.kick) return std::nullopt;
  if (!can_kick_in_passing(ball, aim, situation, constants_)) return std::nullopt;
  const Pose2& feet = situation.robot.feet_in_odometry;
  const Vector2d in_feet = feet.inverse() * ball.position;
  Decision decision;
  decision.phase = PlayPhase::kKick;
  decision.target = aim.target;
  decision.gaze.point = ball.position;
  const bool is_left = in_feet.y() > 0;
  decision.action =
      ActionCommand{is_left ? constants_.actions.kick_left : constants_.actions.kick_right,
                    in_feet.x(), in_feet.y(), std::numeric_limits<double>::quiet_NaN()};
  decision.walks_on = true;
  decision.walk.vx = std::min(parameters_.passing_speed, constants_.walk_limits.forward);
  kicked_ball_ = ball.position;
  kick_heading_ = feet.heading;
  kick_start_ = situation.time;
  is_passing_ = true;
  return decision;
}

Decision Striker::settle(const Ball& ball, const Situation& situation) {
  const Pose2& feet = situation.robot.feet_in_odometry;
  Decision decision;
  decision.phase = PlayPhase::kAlign;
  decision.gaze.point = ball.position;
  const Aim& aim = settled_aim_;
  decision.target = aim.target;
  if (!situation.is_still) {
    still_since_.reset();
    if (situation.time - stage_start_ > 3 * parameters_.settle_timeout) stage_ = Stage::kApproach;
    return decision;
  }
  if (!still_since_) still_since_ = situation.time;
  const double still = situation.time - *still_since_;
  const bool has_seen = ball.seen_time > *still_since_ + 0.5 * parameters_.settle_time;
  if (still < parameters_.settle_time || (!has_seen && still < parameters_.settle_timeout))
    return decision;
  if (task_ == Task::kGoToBall) {
    decision.phase = PlayPhase::kDone;
    decision.is_done = true;
    return decision;
  }
  ++num_settles_;
  stage_ = Stage::kApproach;
  if (!constants_.kick) {
    decision.is_done = true;
    decision.has_failed = true;
    decision.reason = Reason("no-kick", {"robot"});
    return decision;
  }
  const Vector2d in_feet = feet.inverse() * ball.position;
  const double side = in_feet.y() > 0 ? 1 : -1;
  const Vector2d place(constants_.kick->ball.x(), side * constants_.kick->ball.y());
  const Vector2d off = (in_feet - place).cwiseAbs();
  const Vector2d reach = parameters_.kick_fraction * constants_.kick->reach;
  const bool is_aimed = std::abs(wrapped(aim.heading - feet.heading)) < aim.tolerance;
  if (off.x() > reach.x() || off.y() > reach.y() || !is_aimed || ball.is_rolling) return decision;
  decision.phase = PlayPhase::kKick;
  decision.action =
      ActionCommand{side > 0 ? constants_.actions.kick_left : constants_.actions.kick_right,
                    in_feet.x(), in_feet.y(), std::numeric_limits<double>::quiet_NaN()};
  kicked_ball_ = ball.position;
  kick_heading_ = feet.heading;
  kick_start_ = situation.time;
  is_passing_ = false;
  return decision;
}

Decision Striker::push(const Ball& ball, const Situation& situation) {
  const Pose2& feet = situation.robot.feet_in_odometry;
  const Aim aim = calc_aim(situation.ball->position, situation);
  const Vector2d in_feet = feet.inverse() * situation.ball->position;
  Decision decision;
  decision.phase = PlayPhase::kKick;
  decision.target = aim.target;
  decision.gaze.point = ball.position;
  // The foot in front of which the ball lies dribbles it.
  if (task_ == Task::kScore) side_ = in_feet.y() > 0 ? 1 : -1;
  const double aside = in_feet.y() - side_ * (constants_.kick ? constants_.kick->ball.y() : 0);
  const double turn = wrapped(aim.heading - feet.heading);
  decision.walk = {std::min(parameters_.push_speed, constants_.walk_limits.forward), 1.2 * aside,
                   turn};
  if (task_ == Task::kScore && !may_carry_on(ball, situation, constants_)) {
    stage_ = Stage::kApproach;
  }
  if (in_feet.norm() > constants_.parameters.ball_in_walk.push_reach || std::abs(aside) > 0.1 ||
      std::abs(turn) > 0.5) {
    stage_ = Stage::kApproach;
  }
  return decision;
}

Decision Striker::watch(const Situation& situation) {
  Decision decision;
  decision.phase = PlayPhase::kKick;
  const double time = situation.time - stage_start_;
  decision.gaze.point =
      time < parameters_.look_down
          ? kicked_ball_
          : kicked_ball_ + 2 * Vector2d(std::cos(kick_heading_), std::sin(kick_heading_));
  if (task_ == Task::kKick && time > parameters_.look_down) {
    decision.phase = PlayPhase::kDone;
    decision.is_done = true;
  }
  return decision;
}

}  // namespace nao::play
