#include "daemons/motion/message_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "daemons/motion/actions/taught_script.h"
#include "messages/motion_file.h"
#include "messages/named_joints.h"
#include "messages/reason.h"

namespace nao::motion {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Deviation of a quaternion's norm from 1 up to which it is a rotation: the inertial unit may send
// single-precision or rounded numbers.
constexpr double kOrientationTolerance = 0.01;
// Control periods that a robot may have, s.
constexpr double kMinPeriod = 0.001;
constexpr double kMaxPeriod = 0.1;

// Non-finite numbers stop here; the core can rely on finite measurements.
void require_finite(const double* values, int count, const char* quantity) {
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) {
      throw MessageError(std::string(quantity) + " " + std::to_string(i) +
                         " is not a finite number");
    }
  }
}

// The names decide, not the order: messages may list sensors in any order.
/** Index of the foot force sensor on a link of that name; the number of sensors if there is none.
 */
size_t find_foot_sensor(const RobotModel& model, const std::string& name) {
  const std::vector<int>& links = model.foot_sensors();
  return std::find_if(links.begin(), links.end(),
                      [&](int link) { return model.links()[link].name == name; }) -
         links.begin();
}

// Every joint exactly once, see read_named_joints(). Errors count as dropped messages on the bus.
void read_joints(const RobotModel& model, const naolcm::sensor_state_t& message, Sensors& sensors) {
  const auto fault = read_named_joints(
      model.motor_names(), message.joint_names,
      {{"position", message.joint_position, sensors.position},
       {"velocity", message.joint_velocity, sensors.velocity},
       {"torque", message.joint_torque, sensors.torque},
       {"target position", message.joint_target_position, sensors.target_position},
       {"stiffness", message.joint_stiffness, sensors.stiffness, 0, 1}});
  if (fault) throw MessageError(to_sentence(*fault));
}

void read_inertial_unit(const naolcm::sensor_state_t& message, Sensors& sensors) {
  require_finite(message.accelerometer_torso, 3, "accelerometer");
  require_finite(message.gyroscope_torso, 3, "gyroscope");
  require_finite(message.orientation_torso_in_world, 4, "orientation");
  sensors.accelerometer_torso = Eigen::Vector3d(message.accelerometer_torso);
  sensors.gyroscope_torso = Eigen::Vector3d(message.gyroscope_torso);
  // w first in messages; the constructor takes the same order.
  const double* q = message.orientation_torso_in_world;
  sensors.orientation_torso_in_world = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  const double norm = sensors.orientation_torso_in_world.norm();
  if (std::abs(norm - 1) > kOrientationTolerance) {
    throw MessageError("the orientation's norm is " + to_argument(norm) + "; it must be 1");
  }
}

void read_foot_sensors(const RobotModel& model, const naolcm::sensor_state_t& message,
                       Sensors& sensors) {
  const size_t num_sensors = model.foot_sensors().size();
  sensors.foot_force.assign(num_sensors, 0);
  std::vector<bool> is_listed(num_sensors, false);
  for (int i = 0; i < message.num_foot_sensors; ++i) {
    const std::string& name = message.foot_sensor_names[i];
    const size_t index = find_foot_sensor(model, name);
    if (index == num_sensors) throw MessageError("the robot has no foot sensor " + quoted(name));
    if (is_listed[index]) throw MessageError("foot sensor " + name + " is listed twice");
    is_listed[index] = true;
    require_finite(&message.foot_force[i], 1, "force of a foot sensor");
    // Noise may make the reading of an unloaded sensor negative; forces on the ground only push.
    sensors.foot_force[index] = std::max(0.0, message.foot_force[i]);
  }
  for (size_t index = 0; index < num_sensors; ++index) {
    if (!is_listed[index]) {
      throw MessageError("foot sensor " + model.links()[model.foot_sensors()[index]].name +
                         " is missing");
    }
  }
}

}  // namespace

Sensors to_sensors(const RobotModel& model, const naolcm::sensor_state_t& message) {
  Sensors sensors;
  sensors.utime = message.utime;
  sensors.tick = message.tick;
  // Written so that NaN fails, too.
  if (!(message.period >= kMinPeriod && message.period <= kMaxPeriod)) {
    throw MessageError("period " + to_argument(message.period) + " s is outside [" +
                       to_argument(kMinPeriod) + ", " + to_argument(kMaxPeriod) + "]");
  }
  sensors.period = message.period;
  read_joints(model, message, sensors);
  read_inertial_unit(message, sensors);
  read_foot_sensors(model, message, sensors);
  return sensors;
}

Command to_command(const naolcm::walk_command_t& message) {
  return {message.source, message.command_id, WalkCommand{message.vx, message.vy, message.wz}};
}

Command to_command(const naolcm::move_to_command_t& message) {
  return {message.source, message.command_id, MoveToCommand{message.x, message.y, message.theta}};
}

Command to_command(const naolcm::posture_command_t& message) {
  return {message.source, message.command_id, PostureCommand{message.posture, message.speed}};
}

Command to_command(const naolcm::joint_change_command_t& message) {
  return {message.source, message.command_id,
          JointChangeCommand{message.joint_names, message.joint_position, message.is_relative != 0,
                             message.speed, message.allow_tipping != 0, message.joint_stiffness}};
}

Command to_command(const naolcm::action_command_t& message) {
  return {message.source, message.command_id,
          ActionCommand{message.action, message.ball_x, message.ball_y, message.strength}};
}

Command to_command(const naolcm::stop_command_t& message) {
  return {message.source, message.command_id, StopCommand{}};
}

std::optional<SeenBall> to_seen_ball(const naolcm::vision_state_t& message) {
  if (message.has_ball == 0) return std::nullopt;
  require_finite(message.ball_position_in_odometry, 2, "position of the ball");
  return SeenBall{message.ball_utime, Eigen::Vector2d(message.ball_position_in_odometry)};
}

TaughtChange to_taught(const RobotModel& model, const naolcm::keyframe_motion_t& message) {
  if (!is_motion_name(message.name))
    throw MessageError(quoted(message.name) + " is not a valid motion name");
  if (message.num_keyframes == 0) return {message.name, nullptr};
  const auto motion = from_message(message);
  if (!motion) throw MessageError("the lists of motion " + message.name + " have unequal lengths");
  auto script = to_script(model, *motion);
  if (const auto* fault = std::get_if<MotionFault>(&script)) {
    throw MessageError("motion " + message.name + ": " + to_sentence(fault->reason));
  }
  return {message.name,
          std::make_shared<const ActionScript>(std::get<ActionScript>(std::move(script)))};
}

naolcm::joint_command_t to_message(const JointTargets& targets, const RobotState& state,
                                   const std::vector<std::string>& names) {
  naolcm::joint_command_t message;
  message.utime = state.utime;
  message.tick = state.tick;
  message.num_joints = static_cast<int>(names.size());
  message.joint_names = names;
  message.joint_position = targets.position;
  // NaN: the servo's own gains, and no velocity target (joint_command_t).
  message.joint_velocity.assign(names.size(), kNan);
  message.joint_torque.assign(names.size(), 0.0);
  message.joint_kp = targets.kp;
  message.joint_kd = targets.kd;
  message.joint_kp.resize(names.size(), kNan);
  message.joint_kd.resize(names.size(), kNan);
  message.joint_stiffness = targets.stiffness;
  return message;
}

naolcm::robot_state_t to_message(const RobotState& state, const std::vector<std::string>& names) {
  naolcm::robot_state_t message;
  message.utime = state.utime;
  message.tick = state.tick;
  message.num_joints = static_cast<int>(names.size());
  message.joint_names = names;
  message.joint_position = state.joint_position;
  message.joint_velocity = state.joint_velocity;
  const Eigen::Quaterniond q(state.torso_in_odometry.linear());
  message.orientation_torso_in_odometry[0] = q.w();
  message.orientation_torso_in_odometry[1] = q.x();
  message.orientation_torso_in_odometry[2] = q.y();
  message.orientation_torso_in_odometry[3] = q.z();
  for (int i = 0; i < 3; ++i) {
    message.position_torso_in_odometry[i] = state.torso_in_odometry.translation()[i];
    message.velocity_torso_in_heading[i] = state.velocity_torso_in_heading[i];
    message.angular_velocity_torso[i] = state.angular_velocity_torso[i];
    message.center_of_mass_in_odometry[i] = state.center_of_mass_in_odometry[i];
  }
  message.center_of_pressure_in_odometry[0] = state.center_of_pressure_in_odometry.x();
  message.center_of_pressure_in_odometry[1] = state.center_of_pressure_in_odometry.y();
  message.left_foot_force = state.left_foot_force;
  message.right_foot_force = state.right_foot_force;
  message.num_support_corners = static_cast<int>(state.support_polygon_in_odometry.size());
  for (const Eigen::Vector2d& corner : state.support_polygon_in_odometry) {
    message.support_corner_in_odometry.push_back({corner.x(), corner.y()});
  }
  return message;
}

naolcm::motion_state_t to_message(const MotionState& state) {
  naolcm::motion_state_t message;
  message.utime = state.utime;
  message.mode = static_cast<int8_t>(state.mode);
  message.posture = state.posture;
  message.command_kind = state.command_kind ? static_cast<int8_t>(*state.command_kind)
                                            : naolcm::motion_state_t::COMMAND_KIND_NONE;
  message.command_name = state.command_name;
  message.command_source = state.command_source;
  message.command_id = state.command_id;
  message.command_progress = state.command_progress;
  message.balance_margin = state.balance_margin;
  message.needs_help = state.needs_help ? 1 : 0;
  message.vx = state.walk_velocity.x();
  message.vy = state.walk_velocity.y();
  message.wz = state.walk_velocity.z();
  message.stiffness = state.stiffness;
  message.last_refusal_code = state.last_refusal.code;
  message.num_last_refusal_arguments = static_cast<int>(state.last_refusal.arguments.size());
  message.last_refusal_arguments = state.last_refusal.arguments;
  message.last_refusal = to_sentence(state.last_refusal);
  message.num_footsteps = static_cast<int>(state.footsteps.size());
  for (const Footstep& footstep : state.footsteps) {
    naolcm::footstep_t part;
    part.is_left = footstep.is_left ? 1 : 0;
    part.position_in_odometry[0] = footstep.position_in_odometry.x();
    part.position_in_odometry[1] = footstep.position_in_odometry.y();
    part.heading_in_odometry = footstep.heading_in_odometry;
    message.footsteps.push_back(part);
  }
  return message;
}

naolcm::policy_state_t to_message(const PolicyRecord& record, int64_t utime) {
  naolcm::policy_state_t message;
  message.utime = utime;
  message.policy = record.policy;
  message.num_observations = static_cast<int>(record.observation.size());
  message.observation = record.observation;
  message.num_joints = static_cast<int>(record.joint_names.size());
  message.joint_names = record.joint_names;
  message.action = record.action;
  message.action.resize(record.joint_names.size());
  message.inference_time = record.inference_time;
  return message;
}

}  // namespace nao::motion
