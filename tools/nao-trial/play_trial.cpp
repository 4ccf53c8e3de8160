#include "tools/nao-trial/play_trial.h"

#include <fmt/core.h>

#include <cmath>

#include "common/output_file.h"

namespace nao::trial {
namespace {

/** s: of PlayCore's steps, as in PlayDaemon, and of repeated play commands. */
constexpr double kStepPeriod = 0.05;
constexpr double kCommandPeriod = 0.5;
constexpr int64_t kCommandId = 1;
const char* const kSource = "play.trial";

play::PlayConstants constants_of(const RobotModel& model, const std::string& scene,
                                 const Pose2& start) {
  play::PlayConstants constants = play::load_constants(model, scene);
  constants.start_in_field = start;
  return constants;
}

}  // namespace

void place_standing(ClosedLoop& trial, const Pose2& pose) {
  const Eigen::Quaterniond upright(trial.torso_in_world().linear());
  const Eigen::Quaterniond turned =
      Eigen::AngleAxisd(pose.heading, Eigen::Vector3d::UnitZ()) * upright;
  trial.world().place_robot(trial.robot(), nullptr, {pose.position.x(), pose.position.y(), 0},
                            &turned);
  trial.restart_core();
}

PlayingRobot::PlayingRobot(ClosedLoop& trial, const std::string& scene, const Pose2& start)
    : trial_(trial),
      viewer_(trial.model()),
      core_(constants_of(trial.model(), scene, start), viewer_.head_limits(), viewer_.head_joints(),
            kSource, 1) {}

void PlayingRobot::set_perception(std::unique_ptr<TrialPerception> perception) {
  perception_ = std::move(perception);
}

void PlayingRobot::command(Behavior behavior) {
  command_.behavior = behavior;
  next_command_ = 0;
}

play::PlayInput PlayingRobot::make_input() {
  play::PlayInput input;
  input.now = input.time = trial_.time();
  if (command_.behavior != Behavior::kNone && trial_.time() >= next_command_) {
    next_command_ = trial_.time() + kCommandPeriod;
    input.requests.push_back({"trial", kCommandId, command_});
  }
  for (CommandResult& result : trial_.take_results()) {
    if (result.source == kSource) input.results.push_back(std::move(result));
  }
  const motion::MotionState& motion = trial_.core().motion_state();
  input.mode = motion.mode;
  input.needs_help = motion.needs_help;
  const motion::RobotState& state = trial_.estimate();
  input.robot = viewer_.look(state.torso_in_odometry, state.joint_position);
  input.vision = vision_;
  input.match = match_;
  return input;
}

void PlayingRobot::step() {
  vision_ = perception_->step(camera_);
  const bool is_fallen = trial_.core().motion_state().mode == Mode::kFallen;
  if (is_fallen && !is_fallen_) ++num_falls_;
  is_fallen_ = is_fallen;
  if (trial_.time() < next_step_) return;
  next_step_ = trial_.time() + kStepPeriod - 1e-6;
  const play::PlayOutput output = core_.step(make_input());
  camera_ = output.camera;
  for (const Command& command : output.commands) {
    // Commands are repeated until they are answered.
    const bool is_action = std::holds_alternative<ActionCommand>(command.request);
    if (is_action && command.id != last_action_id_) {
      last_action_id_ = command.id;
      ++num_actions_;
    }
    trial_.pass_on(command);
  }
  for (const CommandResult& result : output.results) result_ = result;
}

PlayTrial::PlayTrial(const ClosedLoopOptions& options, uint64_t seed,
                     const PerceptionFactory& perception, const Pose2& robot_in_field,
                     const Pose2& start, const Eigen::Vector2d& ball)
    : trial_(options, seed), robot_(trial_, options.scene.name, start) {
  place_standing(trial_, robot_in_field);
  trial_.world().place_ball({ball.x(), ball.y(), 0}, Eigen::Vector3d::Zero());
  trial_.run(1);
  trial_.take_results();
  robot_.set_perception(perception(trial_, options.scene, start, seed, 0));
}

void PlayTrial::step() {
  trial_.step();
  robot_.step();
}

void PlayTrial::trace() {
  if (trace_.empty()) {
    trace_ =
        "time_s,phase,reason,mode,camera,x_m,y_m,heading_rad,height_m,ball_x_m,ball_y_m,seen_x_m,"
        "seen_y_m,"
        "seen_age_s,seen_vx_mps,seen_vy_mps,believed_x_m,believed_y_m,believed_heading_rad\n";
  }
  const Pose2 truth = Pose2::from(trial_.torso_in_world());
  const Eigen::Vector3d ball = trial_.world().ball().position;
  const Pose2 torso = Pose2::from(trial_.estimate().torso_in_odometry);
  const double nan = std::nan("");
  const play::Ball seen =
      robot_.vision().ball.value_or(play::Ball{{nan, nan}, {nan, nan}, nan, false});
  // Converted to the world with the true pose, so that only the error of the ball's perception
  // counts.
  const Eigen::Vector2d place = truth * (torso.inverse() * seen.position);
  const Pose2 believed = robot_.vision().field_in_odometry
                             ? robot_.vision().field_in_odometry->inverse() * torso
                             : Pose2{{nan, nan}, nan};
  trace_ += fmt::format(
      "{:.2f},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.2f},{:.2f},{:."
      "2f},"
      "{:.3f},{:.3f},{:.3f}\n",
      trial_.time(), std::string(to_string(core().state().phase)), core().state().reason.code,
      static_cast<int>(trial_.core().motion_state().mode), robot_.camera(), truth.position.x(),
      truth.position.y(), truth.heading, trial_.torso_height(), ball.x(), ball.y(), place.x(),
      place.y(), trial_.time() - seen.seen_time, seen.velocity.x(), seen.velocity.y(),
      believed.position.x(), believed.position.y(), wrapped(believed.heading));
}

void PlayTrial::write_trace(const std::string& file) const {
  replace_file(file, trace_);
}

}  // namespace nao::trial
