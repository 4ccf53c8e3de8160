#include "daemons/motion/motion_core.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "daemons/motion/generators/fall_motion.h"
#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

// Time after taking over in which the estimate settles before the first motion is chosen, s.
// Chosen: three time constants of the estimated velocities (StateEstimator).
constexpr double kTakeOverTime = 0.1;

MotionOptions validated(const MotionOptions& options) {
  options.validate();
  return options;
}

}  // namespace

MotionCore::MotionCore(const RobotModel& model, const MotionOptions& options)
    : model_(&model),
      options_(validated(options)),
      dead_foot_sensors_(model),
      presence_(model, options.sensor_timeout),
      estimator_(model),
      guard_(model),
      factory_(model, options_, guard_),
      arbiter_(model, factory_, guard_),
      falls_(model, options_),
      limiter_(model),
      gains_(model),
      reporter_(options.motion_state_period),
      standing_(factory_.make_standing_balance()) {
  if (options.calibration) correction_.emplace(model, *options.calibration);
}

// One control tick, or one tick of silence. Order: sensors, commands, motions, reports; commands
// see the state of this tick, and the report sees what the commands made of it.
Output MotionCore::step(const Input& input, double dt) {
  // Correction of the robot's own errors at the border: all motions work with true angles, and
  // targets are converted back below.
  if (input.sensors) {
    corrected_ = *input.sensors;
    if (correction_) correction_->correct(corrected_);
    dead_foot_sensors_.update(corrected_.foot_force, dt);
    take_sensors(corrected_, dt);
  } else {
    wait_for_sensors(dt);
  }
  ball_ = input.ball;
  for (const TaughtChange& change : input.taught) factory_.set_taught(change.name, change.script);
  // Commands are received even without a robot, and refused with the reason "no-robot".
  receive(input.commands);
  Output output;
  if (input.sensors) {
    move(dt);
    balance(dt);
    output.joint_targets = targets_;
    output.joint_targets->position = sent_;
    if (correction_) correction_->to_servos(output.joint_targets->position);
    output.robot_state = estimator_.state();
    const Assignment* running = arbiter_.running();
    const PolicyRecord* record = running ? running->generator->policy_record() : nullptr;
    if (record != nullptr) output.policy = *record;
  }
  output.motion_state =
      reporter_.update({context(dt), targets_, arbiter_, mode(), falls_.needs_help()}, dt);
  output.results = arbiter_.take_results();
  return output;
}

void MotionCore::take_sensors(const Sensors& sensors, double dt) {
  switch (presence_.take(sensors, dt)) {
    case RobotPresence::Change::kAppeared:
      // Running servos hold their targets: going on from them, the robot does not move.
      take_over(false);
      break;
    case RobotPresence::Change::kPlaced:
      arbiter_.abort_all({"no-robot"});
      take_over(true);
      break;
    default:
      break;
  }
  estimator_.update(sensors, dt);
}

// Commands end with the robot; those that come later are refused by the mode.
void MotionCore::wait_for_sensors(double dt) {
  if (presence_.wait(dt) == RobotPresence::Change::kLost) arbiter_.abort_all({"no-robot"});
}

// A robot has appeared, or was placed elsewhere: everything known about it is reset, and all
// motions start from its targets.
void MotionCore::take_over(bool is_placed) {
  const Sensors& sensors = presence_.sensors();
  time_with_robot_ = 0;
  has_first_motion_ = false;
  falls_.reset();
  estimator_.reset();
  // The servos of a robot that was placed elsewhere may still hold targets from before.
  targets_.position = is_placed ? sensors.position : sensors.target_position;
  if (is_placed) clip_to_limits(*model_, targets_.position);
  targets_.velocity.assign(model_->num_motors(), 0.0);
  targets_.stiffness = sensors.stiffness;
  gains_.reset();
  sent_ = targets_.position;
}

void MotionCore::receive(const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    arbiter_.receive(command, context(0), targets_, mode());
  }
}

void MotionCore::move(double dt) {
  // For the limiter, which bounds the change of one tick.
  const JointTargets last = targets_;
  choose_first_motion(dt);
  handle_falls(dt);
  handle_push();
  run_motions(dt);
  gains_.limit(dt, targets_);
  follow_limp_joints();
  limit_targets(last, dt);
}

void MotionCore::choose_first_motion(double dt) {
  time_with_robot_ += dt;
  if (has_first_motion_ || time_with_robot_ < kTakeOverTime) return;
  // Once for a robot: motions are then chosen by commands and falls only.
  has_first_motion_ = true;
  const RobotState& state = estimator_.state();
  falls_.begin(state);
  // A command has come already, or the motors are off and the robot must stay limp.
  if (!arbiter_.is_idle() || is_relaxed()) return;
  const Posture* posture =
      find_present_posture(*model_, presence_.sensors().position, state, options_);
  // In no known posture: a robot that lies is treated as fallen; otherwise it goes to the stand.
  if (posture == nullptr) {
    if (is_lying(state, options_.lying_tilt)) {
      falls_.note_fallen();
      return;
    }
    posture = &factory_.stand();
  }
  arbiter_.assign({factory_.make_posture_path(*posture), std::nullopt, posture->name});
}

void MotionCore::handle_falls(double dt) {
  if (!has_first_motion_) return;
  const Assignment* running = arbiter_.running();
  FallSupervisor::Activity activity;
  activity.is_busy = !arbiter_.is_idle();
  // A robot without a motion stands, and must not fall either.
  activity.must_stay_upright = running == nullptr || running->generator->must_stay_upright();
  activity.is_walking = arbiter_.is_walking();
  if (running != nullptr) {
    activity.walking_tilt = running->generator->fall_tilt().value_or(kWalkingFallTilt);
  }
  switch (falls_.update(estimator_.state(), activity, dt)) {
    case FallSupervisor::Action::kProtect:
      arbiter_.abort_all(running ? running->generator->note_fall() : Reason("robot-fell"));
      // The fall's motion begins in this tick; it cannot wait for the end of another motion.
      arbiter_.start({std::make_unique<FallMotion>(), std::nullopt, "fall"}, context(0), targets_);
      break;
    case FallSupervisor::Action::kGetUp:
      arbiter_.assign({factory_.make_get_up(falls_.num_relapses()), std::nullopt, "get-up"});
      break;
    case FallSupervisor::Action::kNone:
      break;
  }
}

void MotionCore::handle_push() {
  if (!has_first_motion_ || falls_.has_fallen() || is_relaxed()) return;
  const RobotState& state = estimator_.state();
  if (const Assignment* running = arbiter_.running()) {
    const auto walk = running->generator->gait_command();
    const Eigen::Vector3d& velocity = motion_state().walk_velocity;
    auto steps = walk ? factory_.make_walk_recovery(state, velocity, *walk) : nullptr;
    if (steps) arbiter_.hand_over(std::move(steps), context(0), targets_);
  }
  if (!arbiter_.is_idle()) return;
  const bool must_step = standing_ && standing_->must_step(state);
  if (!must_step && !factory_.must_policy_catch(state)) return;
  auto steps = factory_.make_push_recovery(context(0), targets_);
  if (steps == nullptr) return;
  arbiter_.start({std::move(steps), std::nullopt, "push-recovery"}, context(0), targets_);
}

void MotionCore::run_motions(double dt) {
  arbiter_.start_waiting(context(0), targets_);
  // A motion that needs gains of its own commands them in each step.
  targets_.kp.clear();
  targets_.kd.clear();
  if (const auto ended = arbiter_.step(context(dt), targets_)) {
    FallSupervisor::Ended kind = FallSupervisor::Ended::kMotion;
    if (ended->mode == Mode::kFalling) kind = FallSupervisor::Ended::kFall;
    if (ended->keeps_body) kind = FallSupervisor::Ended::kJointChange;
    falls_.note_end(ended->phase == MotionGenerator::Phase::kDone, kind, estimator_.state());
  }
}

void MotionCore::follow_limp_joints() {
  // A robot that rests as a whole keeps the targets of its posture.
  if (is_relaxed()) return;
  for (size_t i = 0; i < targets_.stiffness.size(); ++i) {
    if (targets_.stiffness[i] == 0) targets_.position[i] = presence_.sensors().position[i];
  }
}

void MotionCore::limit_targets(const JointTargets& last, double dt) {
  // The last step for every motion: no target leaves a joint's range or changes faster than its
  // motor turns.
  limiter_.limit(last.position, dt, targets_.position);
  for (size_t i = 0; i < last.position.size(); ++i) {
    // The velocity of the limited targets lets a motion that starts now continue what the servos
    // really receive.
    targets_.velocity[i] = dt > 0 ? (targets_.position[i] - last.position[i]) / dt : 0.0;
  }
}

// A motion that begins does not include the balance's angles; they return to 0 as fast as the
// motors turn.
void MotionCore::balance(double dt) {
  std::vector<double> position = targets_.position;
  if (standing_ && arbiter_.running() == nullptr && !falls_.has_fallen() && !is_relaxed() &&
      find_body_state(*model_, estimator_.state(), options_.lying_tilt) == kOnFeet) {
    standing_->add_to(estimator_.state(), position);
  }
  limiter_.limit(sent_, dt, position);
  sent_ = std::move(position);
}

MotionContext MotionCore::context(double dt) const {
  return {*model_,
          options_,
          presence_.sensors(),
          estimator_.state(),
          estimator_.kinematics(),
          dt,
          ball_ ? &*ball_ : nullptr};
}

Mode MotionCore::mode() const {
  // The first that holds, most urgent first.
  if (!presence_.has_robot()) return Mode::kNoRobot;
  if (arbiter_.running() != nullptr) return arbiter_.running()->generator->mode();
  if (falls_.has_fallen()) return Mode::kFallen;
  if (arbiter_.has_overlay()) return Mode::kMoving;
  return is_relaxed() ? Mode::kRelaxed : Mode::kHolding;
}

bool MotionCore::is_relaxed() const {
  return std::all_of(targets_.stiffness.begin(), targets_.stiffness.end(),
                     [](double stiffness) { return stiffness == 0; });
}

}  // namespace nao::motion
