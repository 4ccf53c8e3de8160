#include "tools/simulation-server/simulation_core.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.h"
#include "tools/simulation-server/simulation_messages.h"

namespace nao::simulation_server {
namespace {

/** @throws ConfigError  if a step's request is not one that can be executed. */
void check(const protocol::Step& step) {
  if (step.num_ticks() < 1 || step.num_ticks() > kMaxTicks) {
    throw ConfigError("num_ticks " + std::to_string(step.num_ticks()) + " is outside [1, " +
                      std::to_string(kMaxTicks) + "]");
  }
  if (step.commands_size() > kMaxCommands) {
    throw ConfigError(std::to_string(step.commands_size()) + " commands; at most " +
                      std::to_string(kMaxCommands) + " are allowed in a step");
  }
  for (const protocol::Command& command : step.commands()) {
    if (command.command_case() == protocol::Command::COMMAND_NOT_SET) {
      throw ConfigError("a command has no content that this program knows");
    }
  }
}

/** @throws ConfigError */
void check_values(const google::protobuf::RepeatedField<double>& values, int num_joints,
                  const std::string& quantity, double lower, double upper) {
  if (values.size() != num_joints) {
    throw ConfigError(std::to_string(values.size()) + " values of " + quantity + " for " +
                      std::to_string(num_joints) + " joints");
  }
  for (const double value : values) {
    if (!std::isfinite(value) || value < lower || value > upper) {
      throw ConfigError(quantity + " " + std::to_string(value) + " is outside [" +
                        std::to_string(lower) + ", " + std::to_string(upper) + "]");
    }
  }
}

}  // namespace

SimulationCore::SimulationCore(ClosedLoopOptions options) : options_(std::move(options)) {}

std::string SimulationCore::handle(std::string_view request) {
  protocol::Request parsed;
  protocol::Response response;
  if (parsed.ParseFromArray(request.data(), static_cast<int>(request.size()))) {
    response = handle(parsed);
  } else {
    response.set_error("the bytes are no Request message");
  }
  return response.SerializeAsString();
}

protocol::Response SimulationCore::handle(const protocol::Request& request) {
  protocol::Response response;
  try {
    switch (request.request_case()) {
      case protocol::Request::kDescribe:
        describe(*response.mutable_description());
        break;
      case protocol::Request::kReset:
        reset(request.reset(), *response.mutable_state());
        break;
      case protocol::Request::kStep:
        step(request.step(), *response.mutable_state());
        break;
      case protocol::Request::REQUEST_NOT_SET:
        response.set_error("the request is not describe, reset or step");
        break;
    }
  } catch (const Error& error) {
    response.set_error(error.what());
  }
  return response;
}

void SimulationCore::describe(protocol::Description& description) const {
  const RobotModel& model = *options_.model;
  description.set_model(model.folder().filename().string());
  description.set_engine(options_.engine);
  description.set_disturbances(options_.disturbances ? options_.disturbances->name() : "default");
  write_description(model, description);
}

void SimulationCore::reset(const protocol::Reset& request, protocol::State& state) {
  ClosedLoopOptions options = options_;
  options.posture = request.posture();
  if (!options.posture.empty() && options.model->find_posture(options.posture) == nullptr) {
    throw ConfigError("the robot has no such posture; it has those of Description.postures");
  }
  // The world is replaced only when the new one is complete, so that a failed reset keeps the old
  // one.
  auto loop = std::make_unique<ClosedLoop>(options, request.seed());
  loop_ = std::move(loop);
  loop_->on_tick([this] {
    if (has_targets_) loop_->world().set_targets(0, targets_);
  });
  has_targets_ = false;
  // The first readings; the motion core takes the robot over.
  loop_->step();
  write_state(true, state);
}

void SimulationCore::step(const protocol::Step& request, protocol::State& state) {
  if (!loop_) throw ConfigError("there is no world yet; send reset first");
  check(request);
  const bool had_targets = has_targets_;
  if (request.has_joint_targets()) {
    set_joint_targets(request.joint_targets());
  } else if (had_targets) {
    has_targets_ = false;
    loop_->restart_core();
  }
  for (const protocol::Command& command : request.commands()) {
    state.add_command_ids(send_command(command, *loop_));
  }
  for (uint32_t i = 0; i < request.num_ticks(); ++i) loop_->step();
  write_state(request.with_truth(), state);
}

void SimulationCore::set_joint_targets(const protocol::JointTargets& targets) {
  const RobotModel& model = *options_.model;
  const int num_joints = model.num_motors();
  // More than any joint's range: a larger number is a mistake, such as degrees.
  constexpr double kMaxAngle = 2 * M_PI;
  check_values(targets.position(), num_joints, "position", -kMaxAngle, kMaxAngle);
  if (targets.stiffness_size() > 0) {
    check_values(targets.stiffness(), num_joints, "stiffness", 0, 1);
  }
  // More than any robot's servo has; a larger number is a mistake.
  constexpr double kMaxGain = 1e4;
  for (const auto& [gains, name] :
       {std::pair(&targets.kp(), "kp"), std::pair(&targets.kd(), "kd")}) {
    if (gains->size() > 0) check_values(*gains, num_joints, name, 0, kMaxGain);
  }
  if (targets.kp_size() != targets.kd_size()) throw ConfigError("kp and kd must both be given");
  targets_.kp = Eigen::VectorXd::Map(targets.kp().data(), targets.kp_size());
  targets_.kd = Eigen::VectorXd::Map(targets.kd().data(), targets.kd_size());
  targets_.position.resize(num_joints);
  targets_.stiffness.setOnes(num_joints);
  for (int i = 0; i < num_joints; ++i) {
    const Joint& joint = model.motor_joint(i);
    targets_.position[i] = std::clamp(targets.position(i), joint.lower, joint.upper);
    if (targets.stiffness_size() > 0) targets_.stiffness[i] = targets.stiffness(i);
  }
  has_targets_ = true;
  // From the first tick on.
  loop_->world().set_targets(0, targets_);
}

void SimulationCore::write_state(bool with_truth, protocol::State& state) {
  nao::simulation_server::write_state(*loop_, state);
  for (const CommandResult& result : loop_->take_results()) {
    write_result(result, *state.add_results());
  }
  if (with_truth) write_truth(*loop_, *state.mutable_truth());
}

}  // namespace nao::simulation_server
