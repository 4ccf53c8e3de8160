#include "daemons/motion/motion_core.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.h"
#include "daemons/motion/commands/acceptance.h"
#include "daemons/motion/commands/command_check.h"
#include "daemons/motion/generators/fall_motion.h"
#include "daemons/motion/generators/joint_change_motion.h"
#include "daemons/motion/generators/journey_motion.h"
#include "daemons/motion/generators/kick_motion.h"
#include "daemons/motion/generators/posture_motion.h"
#include "daemons/motion/generators/rest_motion.h"
#include "daemons/motion/generators/script_motion.h"
#include "daemons/motion/generators/sequence_motion.h"
#include "daemons/motion/generators/walk_motion.h"
#include "daemons/motion/standing_rates.h"
#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

constexpr const char* kFirstPosture = "StandInit";
constexpr const char* kGaitFile = "gait.yaml";
constexpr const char* kKickFile = "actions/kick.yaml";
constexpr const char* kScriptFile = "actions/keeper.yaml";
// A kick asked for while the robot walks is struck in passing, unless it is to be stronger than
// this.
constexpr double kWalkKickStrength = 0.5;
constexpr const char* kRestPosture = "Crouch";

// Time after taking over in which the estimate settles before the first motion is chosen, s.
constexpr double kTakeOverTime = 0.1;
// A joint that turned this much farther in one tick than its motor can was not turned by it:
// somebody has placed the robot anew, rad.
constexpr double kPlacedAngle = 0.5;
// Measured angles may be this far off a posture that the robot is said to be in, rad (5 degrees:
// the servos' lag and the encoders' steps).
constexpr double kInPostureTolerance = 0.09;
// Torso height below which a robot does not stand, m; a crouch has 0.229.
constexpr double kLeastStandingHeight = 0.15;

/** An angle as an argument, rounded towards 0. @param angle  rad. */
std::string whole_degrees(double angle) {
  return std::to_string(std::lround(std::trunc(angle * 180 / M_PI)));
}

bool has_changed(const MotionState& a, const MotionState& b) {
  return a.mode != b.mode || a.posture != b.posture || a.command_kind != b.command_kind ||
         a.command_source != b.command_source || a.command_id != b.command_id ||
         a.command_name != b.command_name || a.needs_help != b.needs_help ||
         a.last_refusal != b.last_refusal;
}

}  // namespace

MotionCore::MotionCore(const RobotModel& model, const MotionOptions& options)
    : model_(&model),
      options_(options),
      limiter_(model),
      graph_(options.transitions
                 ? *options.transitions
                 : TransitionGraph::load(model, model.folder() / "transitions.yaml")),
      estimator_(model, options.foot_contact_force),
      tipping_guard_(model),
      collision_guard_(model),
      fall_monitor_(options.lying_tilt) {
  options_.validate();
  if (model.find_posture(kFirstPosture) == nullptr) {
    throw ModelError(model.name() + " has no posture " + kFirstPosture);
  }
  // A robot without a gait is a robot that does not walk.
  gait_ = options.gait;
  const std::filesystem::path file = model.folder() / kGaitFile;
  if (!gait_ && std::filesystem::exists(file)) gait_ = Gait::load(file);
  const std::filesystem::path kick = model.folder() / kKickFile;
  if (std::filesystem::exists(kick)) kick_ = Kick::load(kick);
  const std::filesystem::path scripts = model.folder() / kScriptFile;
  if (std::filesystem::exists(scripts)) scripts_ = ActionScript::load(model, scripts);
}

Output MotionCore::step(const Input& input, double dt) {
  output_ = Output();
  if (input.sensors) {
    take_sensors(*input.sensors, dt);
  } else {
    silence_ += dt;
    if (has_robot_ && silence_ >= options_.sensor_timeout) lose_robot();
  }
  for (const Command& command : input.commands) receive(command);
  if (input.sensors) {
    move(dt);
    output_.joint_targets = targets_;
    output_.robot_state = estimator_.state();
  }
  report(dt);
  return std::move(output_);
}

void MotionCore::take_sensors(const Sensors& sensors, double dt) {
  bool is_another_robot = !has_robot_ || sensors.tick < sensors_.tick;
  if (!is_another_robot) {
    for (int motor = 0; motor < model_->num_motors(); ++motor) {
      const double farthest = model_->motor_joint(motor).max_velocity * dt + kPlacedAngle;
      is_another_robot = is_another_robot ||
                         std::abs(sensors.position[motor] - sensors_.position[motor]) > farthest;
    }
  }
  sensors_ = sensors;
  silence_ = 0;
  if (is_another_robot) take_over(sensors, has_robot_);
  estimator_.update(sensors, dt);
}

void MotionCore::lose_robot() {
  has_robot_ = false;
  end_running(ResultStatus::kFailed, {"no-robot"});
  end_overlay(ResultStatus::kFailed, {"no-robot"});
  overlaid_.clear();
  if (waiting_) {
    if (waiting_->command) {
      answer(*waiting_->command, ResultStatus::kFailed, {"no-robot"});
    }
    waiting_.reset();
  }
}

void MotionCore::take_over(const Sensors& sensors, bool is_placed) {
  if (has_robot_) lose_robot();
  has_robot_ = true;
  time_with_robot_ = 0;
  has_first_motion_ = false;
  needs_help_ = false;
  estimator_.reset();
  // What the servos of a robot that was put elsewhere hold may still be from before.
  targets_.position = is_placed ? sensors.position : sensors.target_position;
  if (is_placed) clip_to_limits(*model_, targets_.position);
  targets_.velocity.assign(model_->num_motors(), 0.0);
  targets_.stiffness = sensors.stiffness;
}

void MotionCore::choose_first_motion() {
  has_first_motion_ = true;
  was_lying_ = is_lying();
  if (running_ || waiting_ || is_limp()) return;
  const std::string state = find_body_state(*model_, estimator_.state(), options_.lying_tilt);
  for (const Posture& posture : model_->postures()) {
    if (deviation_from(posture, sensors_.position).angle >= kInPostureTolerance) continue;
    if (state_of(posture) != state) continue;
    assign({std::make_unique<JourneyMotion>(graph_, posture, options_.default_speed), std::nullopt,
            posture.name});
    return;
  }
  if (was_lying_) {
    has_fallen_ = true;
    return;
  }
  assign({std::make_unique<JourneyMotion>(graph_, *model_->find_posture(kFirstPosture),
                                          options_.default_speed),
          std::nullopt, kFirstPosture});
}

void MotionCore::receive(const Command& command) {
  if (const auto fault = find_sender_fault(command)) {
    answer(command, ResultStatus::kRefused, *fault, false);
    return;
  }
  if (const CommandResult* known = ledger_.find(command.source, command.id)) {
    const bool is_running = running_ && running_->command &&
                            running_->command->source == command.source &&
                            running_->command->id == command.id;
    const bool is_waiting = waiting_ && waiting_->command &&
                            waiting_->command->source == command.source &&
                            waiting_->command->id == command.id;
    if (!find_fault(*model_, command)) {
      if (is_running) running_->generator->adopt(command);
      if (is_waiting) waiting_->generator->adopt(command);
    }
    output_.results.push_back(*known);
    return;
  }
  if (const auto fault = find_fault(*model_, command)) {
    answer(command, ResultStatus::kRefused, *fault);
    return;
  }
  if (const auto obstacle = find_mode_obstacle(kind_of(command), current_mode())) {
    answer(command, ResultStatus::kRefused, *obstacle);
    return;
  }
  if (adopt_walk(command) || adopt_kick(command) || overlay_walk(command)) return;
  Plan planned = plan(command);
  if (const auto* refusal = std::get_if<Reason>(&planned)) {
    answer(command, ResultStatus::kRefused, *refusal);
    return;
  }
  answer(command, ResultStatus::kAccepted, {});
  assign(
      {std::move(std::get<std::unique_ptr<MotionGenerator>>(planned)), command, describe(command)});
}

bool MotionCore::adopt_walk(const Command& command) {
  const auto* walk = std::get_if<WalkCommand>(&command.request);
  if (walk == nullptr || waiting_) return false;
  const bool is_walking =
      running_ && running_->command && kind_of(*running_->command) == CommandKind::kWalk;
  if (!is_walking) {
    if (walk->vx != 0 || walk->vy != 0 || walk->wz != 0) return false;
    answer(command, ResultStatus::kAccepted, {});
    answer(command, ResultStatus::kDone, {"not-walking"});
    return true;
  }
  if (!running_->generator->adopt(command)) return false;
  answer(*running_->command, ResultStatus::kInterrupted, {"replaced", {describe(command)}});
  answer(command, ResultStatus::kAccepted, {});
  running_->command = command;
  running_->detail = describe(command);
  return true;
}

bool MotionCore::is_walking() const {
  return running_ && running_->generator->mode() == Mode::kWalking;
}

bool MotionCore::overlay_walk(const Command& command) {
  const auto* change = std::get_if<JointChangeCommand>(&command.request);
  if (change == nullptr || waiting_ || !is_walking()) return false;
  std::vector<int> motors;
  for (const std::string& name : change->joint_names) {
    motors.push_back(model_->find_motor(name));
    if (carries_body(context(0), motors.back())) return false;
  }
  // The joints that walk are not its concern.
  JointTargets start = targets_;
  for (int motor = 0; motor < model_->num_motors(); ++motor) {
    const bool turns = std::find(motors.begin(), motors.end(), motor) != motors.end();
    if (!turns) start.velocity[motor] = 0;
  }
  if (const auto danger = find_self_collision(*change, start)) {
    answer(command, ResultStatus::kRefused, *danger);
    return true;
  }
  answer(command, ResultStatus::kAccepted, {});
  end_overlay(ResultStatus::kInterrupted, {"replaced", {describe(command)}});
  overlay_ = Overlay{std::make_unique<JointChangeMotion>(*change), command, std::move(motors)};
  overlay_->generator->start(context(0), start);
  return true;
}

MotionCore::Plan MotionCore::plan(const Command& command) {
  return std::visit([this](const auto& request) { return plan_request(request); }, command.request);
}

bool MotionCore::adopt_kick(const Command& command) {
  const auto* action = std::get_if<ActionCommand>(&command.request);
  if (action == nullptr || waiting_ || !running_) return false;
  const bool is_kick = action->action == "kick-left" || action->action == "kick-right";
  // No strength said is NaN, which is not above.
  if (!is_kick || action->strength > kWalkKickStrength) return false;
  if (!running_->generator->adopt(command)) return false;
  if (walk_kick_)
    answer(*walk_kick_, ResultStatus::kInterrupted, {"replaced", {describe(command)}});
  answer(command, ResultStatus::kAccepted, {});
  walk_kick_ = command;
  return true;
}

void MotionCore::watch_kick() {
  if (!walk_kick_) return;
  const auto strike = running_ ? running_->generator->strike() : MotionGenerator::Strike::kNone;
  if (strike == MotionGenerator::Strike::kPending) return;
  if (strike == MotionGenerator::Strike::kStruck) {
    answer(*walk_kick_, ResultStatus::kDone, {});
  } else {
    const bool is_missed = strike == MotionGenerator::Strike::kMissed;
    answer(*walk_kick_, ResultStatus::kFailed,
           is_missed ? Reason("kick-missed") : Reason("walk-ended-before-kick"));
  }
  walk_kick_.reset();
}

std::optional<Reason> MotionCore::refuse_walk() const {
  if (!gait_) return Reason("no-gait", {model_->name()});
  if (is_lying()) return Reason("robot-fallen");
  return find_walk_obstacle(LegKinematics(*model_), estimator_.state(), targets_.stiffness);
}

std::unique_ptr<MotionGenerator> MotionCore::plan_stand() const {
  return std::make_unique<JourneyMotion>(graph_, *model_->find_posture(kFirstPosture),
                                         options_.default_speed);
}

std::optional<Reason> MotionCore::refuse_walk_after_standing_up() const {
  if (!gait_ || !sits()) return refuse_walk();
  return find_soft_leg(LegKinematics(*model_), targets_.stiffness);
}

MotionCore::Plan MotionCore::plan_request(const WalkCommand& walk) {
  if (const auto refusal = refuse_walk_after_standing_up()) return *refusal;
  return std::make_unique<WalkMotion>(*model_, *gait_, plan_stand(), walk);
}

MotionCore::Plan MotionCore::plan_request(const MoveToCommand& move_to) {
  if (const auto refusal = refuse_walk_after_standing_up()) return *refusal;
  return std::make_unique<MoveToMotion>(*model_, *gait_, plan_stand(), move_to);
}

MotionCore::Plan MotionCore::plan_request(const PostureCommand& posture) {
  const Posture& goal = *model_->find_posture(posture.posture);
  const std::string state = find_body_state(*model_, estimator_.state(), options_.lying_tilt);
  const bool is_there = state == state_of(goal);
  if (!is_there && !state.empty() && graph_.find_way(state, state_of(goal)).empty()) {
    return Reason("no-path", {state, goal.name});
  }
  return std::make_unique<JourneyMotion>(graph_, goal, posture.speed);
}

MotionCore::Plan MotionCore::plan_request(const JointChangeCommand& change) {
  if (auto danger = find_danger(change)) return *danger;
  return std::make_unique<JointChangeMotion>(change);
}

MotionCore::Plan MotionCore::plan_request(const ActionCommand& action) {
  const Posture& stand = *model_->find_posture(kFirstPosture);
  const double speed = options_.default_speed;
  if (action.action == "get-up" || action.action == "wake-up") {
    return std::make_unique<JourneyMotion>(graph_, stand, speed);
  }
  if (action.action == "rest") {
    return std::make_unique<RestMotion>(graph_, *model_->find_posture(kRestPosture), speed);
  }
  if (action.action == "kick-left" || action.action == "kick-right") {
    return plan_kick(action.action == "kick-left", action);
  }
  for (const ActionScript& script : scripts_) {
    if (script.sequence.name == action.action) return plan_script(script);
  }
  const KeyframeSequence* sequence = graph_.find(action.action);
  if (sequence == nullptr) return Reason("action-without-motion", {action.action});
  const std::string state = find_body_state(*model_, estimator_.state(), options_.lying_tilt);
  if (sequence->from != state) {
    return Reason("action-needs-state",
                  {action.action, sequence->from, state.empty() ? "unknown" : state});
  }
  return std::make_unique<SequenceMotion>(*sequence);
}

MotionCore::Plan MotionCore::plan_kick(bool is_left, const ActionCommand& action) {
  if (!kick_) return Reason("no-kick", {model_->name()});
  if (const auto refusal = refuse_walk()) return *refusal;
  const Eigen::Vector2d ball(action.ball_x, action.ball_y);
  if (const auto refusal = KickMotion::find_obstacle(*kick_, is_left, ball)) return *refusal;
  return std::make_unique<KickMotion>(*model_, *kick_, *gait_, plan_stand(), is_left, ball,
                                      action.strength);
}

MotionCore::Plan MotionCore::plan_script(const ActionScript& script) {
  if (const auto refusal = refuse_walk()) return *refusal;
  return std::make_unique<ScriptMotion>(*model_, script, *gait_, plan_stand(), plan_stand());
}

MotionCore::Plan MotionCore::plan_request(const StopCommand& /*stop*/) {
  return std::make_unique<StopMotion>();
}

std::optional<Reason> MotionCore::find_danger(const JointChangeCommand& change) {
  std::optional<Reason> danger = find_self_collision(change, targets_);
  const bool stands =
      find_body_state(*model_, estimator_.state(), options_.lying_tilt) == "on-feet";
  if (danger || change.allow_tipping || !stands) return danger;
  return find_tipping(change);
}

std::optional<Reason> MotionCore::find_self_collision(const JointChangeCommand& change,
                                                      const JointTargets& start) {
  JointChangeMotion motion(change);
  motion.start(context(0), start);
  const std::vector<std::vector<double>> way = motion.calc_way(*model_);
  SelfCollision collision;
  const size_t last = collision_guard_.find_last_free(way, collision);
  if (last + 1 == way.size()) return std::nullopt;
  return Reason("self-collision",
                {model_->motor_joint(collision.motor).name, collision.link_a, collision.link_b,
                 whole_degrees(way[last][collision.motor] - way.front()[collision.motor])});
}

std::optional<Reason> MotionCore::find_tipping(const JointChangeCommand& change) {
  const std::vector<double> goal = JointChangeMotion::calc_goal(*model_, change, targets_.position);
  Rest tipping;
  const Eigen::Vector3d up = estimator_.state().torso_in_odometry.linear().row(2);
  const double safe_share = tipping_guard_.find_safe_share(targets_.position, goal, up, tipping);
  if (safe_share >= 1) return std::nullopt;
  // Of the joints named, the one that turns the body over its feet most: legs before all others.
  const Eigen::Matrix3Xd left = estimator_.kinematics().calc_angular_jacobian(model_->left_sole());
  const Eigen::Matrix3Xd right =
      estimator_.kinematics().calc_angular_jacobian(model_->right_sole());
  int culprit = -1;
  double largest = -1;
  for (const std::string& name : change.joint_names) {
    const int motor = model_->find_motor(name);
    const bool is_leg = !left.col(motor).isZero(0) || !right.col(motor).isZero(0);
    const double weight = std::abs(goal[motor] - targets_.position[motor]) * (is_leg ? 1.0 : 1e-3);
    if (weight <= largest) continue;
    largest = weight;
    culprit = motor;
  }
  const Eigen::Vector3d& direction = tipping.tipping_direction;
  const std::vector<std::string> arguments = {
      model_->motor_joint(culprit).name,
      whole_degrees(safe_share * (goal[culprit] - targets_.position[culprit]))};
  if (std::abs(direction.x()) >= std::abs(direction.y())) {
    return direction.x() > 0 ? Reason("tipping-forward", arguments)
                             : Reason("tipping-backward", arguments);
  }
  return direction.y() > 0 ? Reason("tipping-left", arguments) : Reason("tipping-right", arguments);
}

void MotionCore::assign(Assignment assignment) {
  if (waiting_ && waiting_->command) {
    answer(*waiting_->command, ResultStatus::kInterrupted, {"replaced-before-start"});
  }
  waiting_ = std::move(assignment);
}

void MotionCore::start_waiting() {
  if (!waiting_) return;
  if (running_ && !running_->generator->can_be_replaced()) {
    running_->generator->finish();
    waiting_->has_waited = true;
    return;
  }
  end_running(ResultStatus::kInterrupted, waiting_->command
                                              ? Reason("replaced", {waiting_->detail})
                                              : Reason("replaced-by-motion", {waiting_->detail}));
  end_overlay(ResultStatus::kInterrupted, waiting_->command
                                              ? Reason("replaced", {waiting_->detail})
                                              : Reason("replaced-by-motion", {waiting_->detail}));
  if (const auto danger = find_new_danger(*waiting_)) {
    answer(*waiting_->command, ResultStatus::kFailed, *danger);
    waiting_.reset();
    return;
  }
  running_ = std::exchange(waiting_, std::nullopt);
  running_->generator->start(context(0), targets_);
}

std::optional<Reason> MotionCore::find_new_danger(const Assignment& assignment) {
  if (!assignment.has_waited || !assignment.command) return std::nullopt;
  const auto* change = std::get_if<JointChangeCommand>(&assignment.command->request);
  return change == nullptr ? std::nullopt : find_danger(*change);
}

void MotionCore::step_overlay(double dt, const JointTargets& last) {
  if (overlay_) {
    JointTargets turned = last;
    const MotionGenerator::Phase phase = overlay_->generator->step(context(dt), turned);
    for (int motor : overlay_->motors) overlaid_[motor] = turned.position[motor];
    if (phase == MotionGenerator::Phase::kDone) {
      end_overlay(ResultStatus::kDone, overlay_->generator->reason());
    }
  }
  if (!overlay_ && !is_walking()) overlaid_.clear();
  for (const auto& [motor, angle] : overlaid_) targets_.position[motor] = angle;
}

void MotionCore::end_overlay(ResultStatus status, const Reason& reason) {
  if (!overlay_) return;
  answer(overlay_->command, status, reason);
  overlay_.reset();
}

void MotionCore::end_running(ResultStatus status, const Reason& reason) {
  if (!running_) return;
  if (running_->command) answer(*running_->command, status, reason);
  running_.reset();
}

void MotionCore::move(double dt) {
  time_with_robot_ += dt;
  if (!has_first_motion_ && time_with_robot_ >= kTakeOverTime) choose_first_motion();
  const JointTargets last = targets_;
  watch_for_falls(dt);
  start_waiting();
  if (running_) {
    const MotionGenerator::Phase phase = running_->generator->step(context(dt), targets_);
    if (phase != MotionGenerator::Phase::kRunning) {
      const Reason reason = running_->generator->reason();
      if (phase == MotionGenerator::Phase::kDone && running_->generator->mode() != Mode::kFalling) {
        has_fallen_ = false;
        was_lying_ = is_lying();
      }
      needs_help_ = phase == MotionGenerator::Phase::kFailed && has_fallen_ && is_lying();
      end_running(
          phase == MotionGenerator::Phase::kDone ? ResultStatus::kDone : ResultStatus::kFailed,
          reason);
    }
  }
  watch_kick();
  step_overlay(dt, last);
  limiter_.limit(last.position, dt, targets_.position);
  for (size_t i = 0; i < last.position.size(); ++i) {
    targets_.velocity[i] = dt > 0 ? (targets_.position[i] - last.position[i]) / dt : 0.0;
  }
}

bool MotionCore::means_to_stand() const {
  if (!has_first_motion_ || has_fallen_) return false;
  if (running_ && !running_->generator->means_to_stand()) return false;
  return !was_lying_;
}

void MotionCore::watch_for_falls(double dt) {
  if (!has_first_motion_) return;
  const RobotState& state = estimator_.state();
  if (means_to_stand()) {
    const bool is_on_feet = state.torso_in_odometry.translation().z() > kLeastStandingHeight;
    const bool steps = running_ && running_->generator->mode() == Mode::kWalking;
    if (is_on_feet && fall_monitor_.update(state, steps, dt)) {
      fall_monitor_.reset();
      has_fallen_ = true;
      time_fallen_ = 0;
      end_running(ResultStatus::kFailed, {"robot-fell"});
      end_overlay(ResultStatus::kFailed, {"robot-fell"});
      overlaid_.clear();
      if (waiting_ && waiting_->command) {
        answer(*waiting_->command, ResultStatus::kFailed, {"robot-fell"});
      }
      waiting_.reset();
      running_ = Assignment{std::make_unique<FallMotion>(), std::nullopt, "fall"};
      running_->generator->start(context(0), targets_);
      return;
    }
  }
  if (running_ || waiting_) {
    time_fallen_ = 0;
    return;
  }
  // Nothing runs: whoever lies now and did not before was knocked over.
  const bool lies = is_lying();
  if (lies && !was_lying_) has_fallen_ = true;
  was_lying_ = lies;
  needs_help_ = needs_help_ && lies;
  if (!has_fallen_) return;
  time_fallen_ += dt;
  if (!options_.gets_up || needs_help_ || time_fallen_ < options_.get_up_delay) return;
  time_fallen_ = 0;
  assign({std::make_unique<JourneyMotion>(graph_, *model_->find_posture(kFirstPosture),
                                          options_.default_speed),
          std::nullopt, "get-up"});
}

void MotionCore::answer(const Command& command, ResultStatus status, const Reason& reason,
                        bool is_remembered) {
  const CommandResult result{command.source, command.id, kind_of(command), status, reason};
  if (is_remembered) ledger_.note(result);
  if (status == ResultStatus::kRefused) last_refusal_ = reason;
  output_.results.push_back(result);
}

MotionContext MotionCore::context(double dt) const {
  return {*model_, options_, sensors_, estimator_.state(), estimator_.kinematics(), dt};
}

bool MotionCore::is_lying() const {
  const Eigen::Vector3d up = estimator_.state().torso_in_odometry.linear().row(2);
  return up.z() < std::cos(options_.lying_tilt);
}

Mode MotionCore::current_mode() const {
  if (!has_robot_) return Mode::kNoRobot;
  if (running_) return running_->generator->mode();
  if (has_fallen_) return Mode::kFallen;
  if (overlay_) return Mode::kMoving;
  return is_limp() ? Mode::kRelaxed : Mode::kHolding;
}

bool MotionCore::sits() const {
  const Posture* posture =
      model_->find_posture(find_body_state(*model_, estimator_.state(), options_.lying_tilt));
  return posture != nullptr && posture->family == "sitting";
}

bool MotionCore::is_limp() const {
  const auto& stiffness = targets_.stiffness;
  return std::all_of(stiffness.begin(), stiffness.end(), [](double share) { return share == 0; });
}

void MotionCore::report(double dt) {
  MotionState state;
  state.utime = sensors_.utime;
  state.mode = current_mode();
  state.last_refusal = last_refusal_;
  if (has_robot_) {
    state.balance_margin = estimator_.state().balance_margin;
    double sum = 0;
    for (double share : targets_.stiffness) sum += share;
    state.stiffness = sum / model_->num_motors();
    if (!running_) {
      for (const Posture& posture : model_->postures()) {
        if (deviation_from(posture, sensors_.position).angle >= kInPostureTolerance) continue;
        if (state_of(posture) !=
            find_body_state(*model_, estimator_.state(), options_.lying_tilt)) {
          continue;
        }
        state.posture = posture.name;
        break;
      }
    }
  }
  if (running_) {
    if (running_->command) {
      state.command_kind = kind_of(*running_->command);
      state.command_source = running_->command->source;
      state.command_id = running_->command->id;
    }
    state.command_name = running_->detail;
    state.command_progress = running_->generator->progress();
    running_->generator->describe(state);
  }
  state.needs_help = needs_help_ && !running_;
  since_motion_state_ += dt;
  // A hair less than the period, so that rounding does not make it one tick longer.
  const bool is_due = since_motion_state_ >= options_.motion_state_period - 1e-6;
  if (is_due || has_changed(state, state_)) {
    since_motion_state_ = 0;
    output_.motion_state = state;
  }
  state_ = std::move(state);
}

}  // namespace nao::motion
