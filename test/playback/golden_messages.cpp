#include "test/playback/golden_messages.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <naolcm/action_command_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/move_to_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <naolcm/world_command_t.hpp>

#include "common/channels.h"
#include "common/error.h"
#include "test/playback/golden_hash.h"

namespace nao::playback {
namespace {

// s, of sessions without a column "period".
constexpr double kPeriod = 0.01;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// As the results stand in the expected traces, in the order of the message's constants.
constexpr std::array kCommandKinds{"walk", "move-to", "posture", "joint-change", "action", "stop"};
constexpr std::array kStatuses{"accepted", "refused", "done", "interrupted", "failed"};

template <size_t N>
std::string name_of(const std::array<const char*, N>& names, int index) {
  if (index < 0 || index >= static_cast<int>(N)) {
    throw Error("a command result has the unknown constant " + std::to_string(index));
  }
  return names[static_cast<size_t>(index)];
}

template <size_t N>
void copy(const std::vector<double>& from, double (&to)[N]) {
  if (from.size() != N) throw Error("the golden session lacks a vector of the sensor state");
  std::copy(from.begin(), from.end(), to);
}

/** Index of each joint of the recording in a message. */
std::vector<size_t> find_joints(const std::vector<std::string>& names,
                                const std::vector<std::string>& joints) {
  std::vector<size_t> indices;
  for (const std::string& joint : joints) {
    const auto found = std::find(names.begin(), names.end(), joint);
    if (found == names.end()) throw Error("no joint " + joint + " in a message");
    indices.push_back(static_cast<size_t>(found - names.begin()));
  }
  return indices;
}

}  // namespace

naolcm::sensor_state_t to_sensor_state(const GoldenTable& table, size_t row) {
  naolcm::sensor_state_t message{};
  message.utime = static_cast<int64_t>(table.values(row, "utime").at(0));
  message.tick = table.tick(row);
  const std::vector<double> period = table.values(row, "period");
  message.period = period.empty() ? kPeriod : period[0];
  message.is_accelerometer_new = 1;
  message.is_gyroscope_new = 1;
  message.joint_names = table.names("joint_position");
  message.num_joints = static_cast<int>(message.joint_names.size());
  message.joint_position = table.values(row, "joint_position");
  message.joint_velocity = table.values(row, "joint_velocity");
  message.joint_torque = table.values(row, "joint_torque");
  message.joint_target_position = table.values(row, "joint_target_position");
  message.joint_stiffness = table.values(row, "joint_stiffness");
  copy(table.values(row, "accelerometer"), message.accelerometer_torso);
  copy(table.values(row, "gyroscope"), message.gyroscope_torso);
  copy(table.values(row, "orientation"), message.orientation_torso_in_world);
  message.foot_sensor_names = table.names("foot_force");
  message.num_foot_sensors = static_cast<int>(message.foot_sensor_names.size());
  message.foot_force = table.values(row, "foot_force");
  return message;
}

naolcm::joint_command_t to_joint_command(const GoldenTable& table, size_t row) {
  naolcm::joint_command_t message{};
  message.utime = static_cast<int64_t>(table.values(row, "utime").at(0));
  message.tick = table.tick(row);
  message.joint_names = table.names("target_position");
  message.num_joints = static_cast<int>(message.joint_names.size());
  message.joint_position = table.values(row, "target_position");
  message.joint_velocity.assign(message.joint_names.size(), kNan);
  message.joint_torque.assign(message.joint_names.size(), 0);
  message.joint_kp.assign(message.joint_names.size(), kNan);
  message.joint_kd.assign(message.joint_names.size(), kNan);
  message.joint_stiffness = table.values(row, "target_stiffness");
  return message;
}

struct GoldenCommand::Fields {
  YAML::Node node;

  std::string text(const char* key) const { return node[key] ? node[key].as<std::string>() : ""; }
  bool flag(const char* key) const { return node[key] && node[key].as<bool>(); }
  /** Null and missing numbers are NaN. */
  static double number(const YAML::Node& value) {
    return value && !value.IsNull() ? value.as<double>() : kNan;
  }
  double number(const char* key) const { return number(node[key]); }
  std::vector<double> numbers(const char* key) const {
    std::vector<double> list;
    for (const YAML::Node& value : node[key]) list.push_back(number(value));
    return list;
  }
  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> list;
    for (const YAML::Node& value : node[key]) list.push_back(value.as<std::string>());
    return list;
  }
  /** A vector of three numbers; zero if it is left out. */
  void copy_vector(const char* key, double (&to)[3]) const {
    if (node[key]) copy(numbers(key), to);
  }
  template <class Message>
  Message event() const {
    Message message{};
    message.source = text("source");
    message.command_id = node["id"].as<int64_t>();
    return message;
  }
};

GoldenCommand::GoldenCommand(const std::string& line) {
  auto fields = std::make_unique<Fields>();
  try {
    fields->node = YAML::Load(line);
    tick_ = fields->node["tick"].as<int64_t>();
    static_cast<void>(fields->node["type"].as<std::string>());
  } catch (const YAML::Exception& error) {
    throw Error("no golden command (" + std::string(error.what()) + "): " + line);
  }
  fields_ = std::move(fields);
}

GoldenCommand::~GoldenCommand() = default;
GoldenCommand::GoldenCommand(GoldenCommand&&) noexcept = default;

void GoldenCommand::publish(Bus& bus) const {
  const RobotChannels channels;
  const Fields& fields = *fields_;
  const std::string type = fields.text("type");
  if (type == "walk") {
    auto message = fields.event<naolcm::walk_command_t>();
    message.vx = fields.number("vx");
    message.vy = fields.number("vy");
    message.wz = fields.number("wz");
    bus.publish(channels.walk_command, message);
  } else if (type == "move-to") {
    auto message = fields.event<naolcm::move_to_command_t>();
    message.x = fields.number("x");
    message.y = fields.number("y");
    message.theta = fields.number("theta");
    bus.publish(channels.move_to_command, message);
  } else if (type == "posture") {
    auto message = fields.event<naolcm::posture_command_t>();
    message.posture = fields.text("posture");
    message.speed = fields.number("speed");
    bus.publish(channels.posture_command, message);
  } else if (type == "joint-change") {
    auto message = fields.event<naolcm::joint_change_command_t>();
    message.joint_names = fields.texts("joint_names");
    message.num_joints = static_cast<int>(message.joint_names.size());
    message.joint_position = fields.numbers("joint_position");
    message.joint_stiffness.assign(message.joint_names.size(), kNan);
    message.is_relative = fields.flag("is_relative") ? 1 : 0;
    message.speed = fields.number("speed");
    message.allow_tipping = fields.flag("allow_tipping") ? 1 : 0;
    bus.publish(channels.joint_change_command, message);
  } else if (type == "action") {
    auto message = fields.event<naolcm::action_command_t>();
    message.action = fields.text("action");
    message.ball_x = fields.number("ball_x");
    message.ball_y = fields.number("ball_y");
    message.strength = fields.number("strength");
    bus.publish(channels.action_command, message);
  } else if (type == "stop") {
    bus.publish(channels.stop_command, fields.event<naolcm::stop_command_t>());
  } else if (type == "world") {
    auto message = fields.event<naolcm::world_command_t>();
    message.command = fields.text("command");
    message.posture = fields.text("posture");
    message.link = fields.text("link");
    fields.copy_vector("position", message.position_in_world);
    fields.copy_vector("velocity", message.velocity_in_world);
    fields.copy_vector("impulse", message.impulse_in_world);
    bus.publish(kWorldCommandChannel, message);
  } else {
    throw Error("no golden command has the type " + type);
  }
}

std::vector<GoldenCommand> read_golden_commands(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Error("cannot read " + file.string());
  std::vector<GoldenCommand> commands;
  for (std::string line; std::getline(stream, line);) commands.emplace_back(line);
  return commands;
}

std::string to_text(const naolcm::command_result_t& message) {
  return message.source + " " + std::to_string(message.command_id) + " " +
         name_of(kCommandKinds, message.command_kind) + " " + name_of(kStatuses, message.status);
}

std::vector<double> targets_of(const naolcm::joint_command_t& message,
                               const std::vector<std::string>& joints) {
  std::vector<double> targets;
  for (const size_t i : find_joints(message.joint_names, joints)) {
    targets.push_back(message.joint_position.at(i));
  }
  return targets;
}

uint64_t hash_of(const naolcm::joint_command_t& message, const std::vector<std::string>& joints) {
  GoldenHash hash;
  hash.add(message.tick);
  for (const size_t i : find_joints(message.joint_names, joints)) {
    hash.add(message.joint_names[i]);
    hash.add(message.joint_position.at(i));
    hash.add(message.joint_stiffness.at(i));
  }
  return hash.value();
}

uint64_t hash_of(const naolcm::sensor_state_t& message, const std::vector<std::string>& joints) {
  GoldenHash hash;
  hash.add(message.tick);
  for (const size_t i : find_joints(message.joint_names, joints)) {
    hash.add(message.joint_names[i]);
    hash.add(message.joint_position.at(i));
    hash.add(message.joint_velocity.at(i));
    hash.add(message.joint_torque.at(i));
    hash.add(message.joint_target_position.at(i));
    hash.add(message.joint_stiffness.at(i));
  }
  hash.add(message.accelerometer_torso);
  hash.add(message.gyroscope_torso);
  hash.add(message.orientation_torso_in_world);
  for (const double force : message.foot_force) hash.add(force);
  return hash.value();
}

uint64_t hash_of(const naolcm::world_truth_t& message, const std::vector<std::string>& joints) {
  const naolcm::robot_truth_t& robot = message.robots.at(0);
  GoldenHash hash;
  hash.add(message.tick);
  hash.add(robot.position_torso_in_world);
  hash.add(robot.orientation_torso_in_world);
  hash.add(robot.velocity_torso_in_world);
  hash.add(robot.angular_velocity_torso_in_world);
  for (const size_t i : find_joints(robot.joint_names, joints)) {
    hash.add(robot.joint_names[i]);
    hash.add(robot.joint_position.at(i));
    hash.add(robot.joint_velocity.at(i));
    hash.add(robot.joint_torque.at(i));
  }
  hash.add(message.position_ball_in_world);
  hash.add(message.orientation_ball_in_world);
  hash.add(message.velocity_ball_in_world);
  hash.add(message.angular_velocity_ball_in_world);
  return hash.value();
}

}  // namespace nao::playback
