#include <cmath>
#include <functional>

#include "tools/nao-trial/perception_model.h"
#include "tools/nao-trial/play_trial.h"
#include "tools/nao-trial/scenarios.h"

namespace nao::trial {
namespace {

using Eigen::Vector2d;

/** Without --duration, s. */
constexpr double kTimeLimit = 90;
/** Distance from the lines at which ball and robot are placed at least, m. */
constexpr double kMargin = 0.3;
/** Distance between ball and robot at least, m. */
constexpr double kApart = 0.4;
/** Shots: distance from the goal's middle, m; greatest speed at the goal line, m/s; and time before
 * the shot in which the keeper takes its position, s. */
constexpr double kShotDistance = 2;
constexpr double kShotSpeed = 1.5;
constexpr double kPreparation = 8;
constexpr double kShotTimeout = 12;
/** Slowest shot at the goal line, m/s: a ball that stops there is not a shot. Chosen. */
constexpr double kLeastShotSpeed = 0.15;
/** The placement has a separate seed, so that it does not change with other draws. */
constexpr uint64_t kPlacementSeed = 0x51ed270b;

/** Time between the lines of a trace, s. */
constexpr double kTracePeriod = 0.1;
/** The whole ball has passed the line: its radius and half of the line's width, m. */
constexpr double kBehindLine = 0.075;

/** @param side  1: the opponent's goal; -1: the robot's own. */
bool is_in_goal(const Vector2d& ball, const play::Field& field, double side) {
  return side * ball.x() > 0.5 * field.length + kBehindLine &&
         std::abs(ball.y()) < 0.5 * field.goal_width;
}

/** Steps, with a trace if one is wanted. */
class TracedSteps {
 public:
  TracedSteps(PlayTrial& play, const ScenarioOptions& options)
      : play_(play), file_(options.trace_file) {}

  void step() {
    play_.step();
    if (file_.empty() || play_.trial().time() < next_) return;
    next_ = play_.trial().time() + kTracePeriod - 1e-6;
    play_.trace();
  }
  void finish() const {
    if (!file_.empty()) play_.write_trace(file_);
  }

 private:
  PlayTrial& play_;
  std::string file_;
  double next_ = 0;
};

std::string describe_end(const PlayTrial& play) {
  const CommandResult& end = play.result();
  if (end.status != ResultStatus::kAccepted) {
    return std::string(to_string(end.status)) + " " + end.reason.code;
  }
  const play::PlayState& state = play.core().state();
  return "too slow, " + std::string(to_string(state.phase)) + " " + state.reason.code;
}

std::vector<RunResult> run_score(const PerceptionFactory& perception,
                                 const ScenarioOptions& options, uint64_t seed) {
  const double limit = options.duration > 0 ? options.duration : kTimeLimit;
  const play::Field field = play::load_constants(*options.trial.model, "soccer").field;
  Random random(seed ^ kPlacementSeed);
  const auto uniform = [&](double low, double high) { return random.uniform(low, high); };
  const auto anywhere = [&] {
    const double x = random.uniform(-0.5 * field.length + kMargin, -kMargin);
    return Vector2d(x, random.uniform(-0.5 * field.width + kMargin, 0.5 * field.width - kMargin));
  };
  const Vector2d position = anywhere();
  const Pose2 robot{position, random.uniform(-M_PI, M_PI)};
  Vector2d ball = anywhere();
  while ((ball - robot.position).norm() < kApart) ball = anywhere();
  PlayTrial play(options.trial, seed, perception, robot, told_start(robot, uniform), ball);
  TracedSteps steps(play, options);
  play.command(Behavior::kScore);
  const double start = play.trial().time();
  const auto ball_now = [&] { return play.trial().world().ball(); };
  bool has_scored = false;
  while (!has_scored && play.trial().time() - start < limit) {
    steps.step();
    has_scored = is_in_goal(ball_now().position.head<2>(), field, 1);
    const bool has_ended = !play.core().is_active() && play.trial().time() - start > 1;
    if (has_ended && ball_now().velocity.norm() < 0.01) break;
  }
  steps.finish();
  RunResult result;
  result.is_success = has_scored;
  if (!has_scored) result.failure = describe_end(play);
  result.metrics = {{"time_s", play.trial().time() - start},
                    {"kicks", static_cast<double>(play.num_actions())},
                    {"falls", static_cast<double>(play.num_falls())}};
  return {result};
}

std::vector<RunResult> run_keep_goal(const PerceptionFactory& perception,
                                     const ScenarioOptions& options, uint64_t seed) {
  const play::Field field = play::load_constants(*options.trial.model, "soccer").field;
  Random random(seed ^ kPlacementSeed);
  const auto uniform = [&](double low, double high) { return random.uniform(low, high); };
  const Vector2d goal(-0.5 * field.length, 0);
  const double bearing = random.uniform(-M_PI / 4, M_PI / 4);
  const double aim = random.uniform(-0.5 * field.goal_width, 0.5 * field.goal_width);
  const double speed = random.uniform(kLeastShotSpeed, kShotSpeed);
  const Vector2d ball = goal + kShotDistance * Vector2d(std::cos(bearing), std::sin(bearing));
  // The keeper stands before its goal, about in its middle.
  const double aside = random.uniform(-0.3, 0.3);
  const Pose2 robot{goal + Vector2d(0.5, aside), random.uniform(-0.3, 0.3)};
  PlayTrial play(options.trial, seed, perception, robot, told_start(robot, uniform), ball);
  TracedSteps steps(play, options);
  play.command(Behavior::kKeepGoal);
  const double start = play.trial().time();
  while (play.trial().time() - start < kPreparation) steps.step();
  // v0^2 = v1^2 + 2 a s: the speed at the ball's place for the drawn one at the goal line.
  const Vector2d way = goal + Vector2d(0, aim) - ball;
  const double deceleration = play.trial().world().options().materials.ball_rolling_deceleration;
  const double first = std::sqrt(speed * speed + 2 * deceleration * way.norm());
  const Vector2d velocity = first * way.normalized();
  play.trial().world().place_ball({ball.x(), ball.y(), 0}, {velocity.x(), velocity.y(), 0});
  const Pose2 torso = Pose2::from(play.trial().torso_in_world());
  // Where the robot's line across its heading is crossed, to its left.
  const Vector2d seen = torso.inverse() * ball;
  const Vector2d going = torso.inverse().rotate(way.normalized());
  const double crossing = seen.y() - going.y() * seen.x() / going.x();
  const double shot = play.trial().time();
  bool is_in = false;
  while (!is_in && play.trial().time() - shot < kShotTimeout) {
    steps.step();
    const sim::BallState& now = play.trial().world().ball();
    is_in = is_in_goal(now.position.head<2>(), field, -1);
    if (now.velocity.norm() < 0.02 && play.trial().time() - shot > 0.5) break;
  }
  steps.finish();
  RunResult result;
  result.is_success = !is_in;
  if (is_in) {
    result.failure = play.num_actions() > 0 ? "goal, in spite of an action" : "goal, no action";
  }
  result.metrics = {
      {"time_s", play.trial().time() - shot}, {"shot_mps", speed}, {"aside_m", std::abs(crossing)}};
  return {result};
}

}  // namespace

Scenario with_perception(Scenario scenario, bool is_rendered) {
  scenario.scene = "soccer";
  if (!is_rendered) {
    scenario.name += "-error-model";
    scenario.summary += ", with an error model instead of images";
  }
  return scenario;
}

Scenario score_scenario(bool is_rendered, const PerceptionFactory& perception) {
  return with_perception({"score",
                          "Score within --duration (90 s), ball and robot anywhere in the own half",
                          {{"time_s", "s"}, {"kicks", "1"}, {"falls", "1"}},
                          std::bind_front(run_score, perception)},
                         is_rendered);
}

Scenario keep_goal_scenario(bool is_rendered, const PerceptionFactory& perception) {
  return with_perception({"keep-goal",
                          "Keep out a shot from 2 m, up to 1.5 m/s at the goal line, aimed "
                          "anywhere at the goal's mouth",
                          {{"time_s", "s"}, {"shot_mps", "m/s"}, {"aside_m", "m"}},
                          std::bind_front(run_keep_goal, perception)},
                         is_rendered);
}

PerceptionFactory perception_model() {
  return [](ClosedLoop& trial, const SceneFile&, const Pose2&, uint64_t seed, int team) {
    return std::make_unique<PerceptionModel>(trial, PerceptionErrors{}, seed, team);
  };
}

}  // namespace nao::trial
