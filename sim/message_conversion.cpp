#include "sim/message_conversion.h"

#include <cmath>
#include <limits>

namespace nao::sim {
namespace {

template <size_t N, class Vector>
void copy(const Vector& from, double (&to)[N]) {
  for (size_t i = 0; i < N; ++i) to[i] = from[static_cast<long>(i)];
}

void copy(const Eigen::Quaterniond& from, double (&to)[4]) {
  // Messages have w first; Eigen stores it last.
  to[0] = from.w();
  to[1] = from.x();
  to[2] = from.y();
  to[3] = from.z();
}

std::vector<double> to_vector(const Eigen::VectorXd& from) {
  return {from.data(), from.data() + from.size()};
}

Eigen::Vector3d to_eigen(const double (&from)[3]) {
  return {from[0], from[1], from[2]};
}

// Time of a robot's last sensor reading in simulated time, as whole microseconds.
int64_t utime_of(const World& world, int robot) {
  return std::llround(world.sensors(robot).time * 1e6);
}

/** Name of a contact's surface in world_truth_t: "NAO/LFoot", "ball", "goal" or "floor". */
std::string surface_name(const World& world, const Surface& surface) {
  switch (surface.kind) {
    case Surface::Kind::kRobot: {
      const SimRobot& robot = world.robot(surface.robot);
      return robot.options().name + "/" + robot.model().links()[surface.link].name;
    }
    case Surface::Kind::kBall:
      return "ball";
    case Surface::Kind::kGoal:
    case Surface::Kind::kNet:
      return "goal";
    default:
      return "floor";
  }
}

naolcm::robot_truth_t robot_truth_of(const SimRobot& robot) {
  const TreeState& state = robot.state();
  naolcm::robot_truth_t truth{};
  truth.robot = robot.options().name;
  truth.model = robot.model().folder().filename().string();
  copy(state.position, truth.position_torso_in_world);
  copy(state.orientation, truth.orientation_torso_in_world);
  // A tree's velocity begins with the root's angular, then its linear one.
  copy(state.velocity.segment<3>(3), truth.velocity_torso_in_world);
  copy(state.velocity.head<3>(), truth.angular_velocity_torso_in_world);
  copy(robot.dynamics().center_of_mass(), truth.center_of_mass_in_world);
  truth.joint_names = robot.model().motor_names();
  truth.num_joints = static_cast<int>(truth.joint_names.size());
  truth.joint_position = to_vector(robot.motor_position());
  truth.joint_velocity = to_vector(robot.motor_velocity());
  truth.joint_torque = to_vector(robot.motor_torque());
  return truth;
}

void add_lights(const SimLights& lights, naolcm::robot_truth_t& truth) {
  for (size_t i = 0; i < lights.names().size(); ++i) {
    const LightColor rgb = lights.color(i);
    if (rgb == LightColor{}) continue;
    truth.light_names.push_back(lights.names()[i]);
    truth.light_rgb.emplace_back(rgb.begin(), rgb.end());
  }
  truth.num_lights = static_cast<int>(truth.light_names.size());
}

void add_lights(const LolaRobot& lola, naolcm::robot_truth_t& truth) {
  for (const LolaMap::Light& light : lola.map().lights) {
    truth.light_names.push_back(light.name);
    const std::array<double, 3> rgb = light_color(lola.held(), light.key);
    truth.light_rgb.push_back({rgb[0], rgb[1], rgb[2]});
  }
  truth.num_lights = static_cast<int>(truth.light_names.size());
}

}  // namespace

// Copies fields only: ranges and lengths are checked in the core, see merge_joint_command() and
// SimCore::take_world_command().
JointCommand to_core(const naolcm::joint_command_t& message) {
  return {message.tick,     message.joint_names, message.joint_position, message.joint_stiffness,
          message.joint_kp, message.joint_kd};
}

WorldCommand to_core(const naolcm::world_command_t& message) {
  WorldCommand command;
  command.source = message.source;
  command.id = message.command_id;
  command.name = message.command;
  command.num_ticks = message.num_ticks;
  command.pace = message.pace;
  command.robot = message.robot;
  command.posture = message.posture;
  command.model = message.model;
  command.position = to_eigen(message.position_in_world);
  for (int i = 0; i < 4; ++i) command.orientation[i] = message.orientation_in_world[i];
  command.velocity = to_eigen(message.velocity_in_world);
  command.link = message.link;
  // Everything in W and in SI units, as the message's comments say.
  command.impulse = to_eigen(message.impulse_in_world);
  command.point = to_eigen(message.point_in_link);
  command.target = to_eigen(message.target_in_world);
  return command;
}

naolcm::sensor_state_t sensor_state_of(const World& world, int index) {
  const SensorReadings& sensed = world.sensors(index);
  const RobotModel& model = world.robot(index).model();
  naolcm::sensor_state_t message;
  // The readings are those of the last tick, with all sensor errors: nothing of the truth may leak
  // into this message.
  message.utime = utime_of(world, index);
  message.tick = sensed.tick;
  message.period = world.options().period();
  message.joint_names = model.motor_names();
  message.num_joints = static_cast<int>(message.joint_names.size());
  message.joint_position = to_vector(sensed.position);
  message.joint_velocity = to_vector(sensed.velocity);
  message.joint_torque = to_vector(sensed.torque);
  message.joint_target_position = to_vector(world.targets(index).position);
  message.joint_stiffness = to_vector(world.targets(index).stiffness);
  copy(sensed.accelerometer, message.accelerometer_torso);
  message.is_accelerometer_new = sensed.is_accelerometer_new ? 1 : 0;
  copy(sensed.gyroscope, message.gyroscope_torso);
  message.is_gyroscope_new = sensed.is_gyroscope_new ? 1 : 0;
  copy(sensed.orientation, message.orientation_torso_in_world);
  for (const int link : model.foot_sensors()) {
    message.foot_sensor_names.push_back(model.links()[link].name);
  }
  message.num_foot_sensors = static_cast<int>(message.foot_sensor_names.size());
  message.foot_force = to_vector(sensed.foot_force);
  return message;
}

naolcm::body_state_t body_state_of(const SimCore& core, int robot) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const SimLights& lights = core.lights(robot);
  naolcm::body_state_t message{};
  message.utime = utime_of(core.world(), robot);
  message.battery_charge = kUnknown;
  message.battery_current = kUnknown;
  message.battery_temperature = kUnknown;
  message.light_names = lights.names();
  message.num_lights = static_cast<int>(message.light_names.size());
  for (size_t i = 0; i < message.light_names.size(); ++i) {
    const LightColor rgb = lights.color(i);
    message.light_rgb.emplace_back(rgb.begin(), rgb.end());
  }
  return message;
}

// Ground truth of the whole world, for viewers and tests; programs that control the robot must not
// read it.
naolcm::world_truth_t world_truth_of(const SimCore& core, double real_time_factor) {
  const SimOptions& options = core.options();
  const World& world = core.world();
  const TickScheduler& scheduler = core.scheduler();
  naolcm::world_truth_t message{};
  message.utime = utime_of(world, 0);
  message.tick = world.tick();
  message.scene = options.scene;
  message.engine = world.options().engine;
  message.disturbances = options.disturbances;
  message.seed = static_cast<int64_t>(options.seed);
  message.floor_seed = static_cast<int64_t>(world.options().floor.seed);
  copy(world.options().gravity, message.gravity_in_world);
  message.is_paused = scheduler.is_stopped() ? 1 : 0;
  message.real_time_factor = real_time_factor;
  message.pace = scheduler.pace();
  message.num_late_commands = scheduler.num_late_commands();
  message.num_late_ticks = scheduler.num_late_ticks();
  // One LoLA robot at most: the lights of its last command are shown on it.
  for (int i = 0; i < world.num_robots(); ++i) {
    message.robots.push_back(robot_truth_of(world.robot(i)));
    const RobotOption& player = options.robots[static_cast<size_t>(i)];
    message.robots.back().team = static_cast<int8_t>(player.team.value_or(0));
    message.robots.back().number = static_cast<int8_t>(player.number);
    if (core.lola()) {
      add_lights(*core.lola(), message.robots.back());
    } else {
      add_lights(core.lights(i), message.robots.back());
    }
  }
  message.num_robots = static_cast<int>(message.robots.size());
  message.has_ball = world.has_ball() ? 1 : 0;
  if (world.has_ball()) {
    const BallState& ball = world.ball();
    copy(ball.position, message.position_ball_in_world);
    copy(ball.orientation, message.orientation_ball_in_world);
    copy(ball.velocity, message.velocity_ball_in_world);
    copy(ball.angular_velocity, message.angular_velocity_ball_in_world);
  }
  // The force on a; contact_t's reader negates it for b.
  for (const Contact& contact : world.contacts()) {
    naolcm::contact_t part;
    part.body_a = surface_name(world, contact.a);
    part.body_b = surface_name(world, contact.b);
    copy(contact.position, part.position_in_world);
    copy(contact.force_on_a, part.force_on_a_in_world);
    message.contacts.push_back(std::move(part));
  }
  message.num_contacts = static_cast<int>(message.contacts.size());
  const WorldCommandOutcome& outcome = core.last_world_command();
  message.last_command_source = outcome.source;
  message.last_command_id = outcome.id;
  message.last_command_error = outcome.error;
  return message;
}

}  // namespace nao::sim
