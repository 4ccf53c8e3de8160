#include <cmath>
#include <cstdio>
#include <memory>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/json_writer.h"
#include "common/wall_clock.h"
#include "inspection/message_json.h"
#include "messages/command.h"
#include "messages/mode.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/terminal.h"
#include "tools/nao/text_table.h"

namespace nao {
namespace {

struct RobotReport {
  std::optional<naolcm::robot_state_t> robot;
  std::optional<naolcm::motion_state_t> motion;
  bool is_complete() const { return robot && motion; }
};

/** Heading of a unit quaternion (w, x, y, z): rotation about the vertical, rad. */
double heading_of(const double* q) {
  return std::atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] * q[2] + q[3] * q[3]));
}

std::string to_text(const naolcm::robot_state_t& robot, const naolcm::motion_state_t& motion) {
  const auto degrees = [](double radians) {
    return format_number(radians * 180 / std::numbers::pi, 1);
  };
  std::string text = std::string("mode      ") + to_string(static_cast<Mode>(motion.mode));
  if (!motion.posture.empty()) text += ", posture " + motion.posture;
  if (motion.needs_help) text += ", needs help";
  if (motion.command_kind != motion.COMMAND_KIND_NONE) {
    text += std::string(", executing ") + to_string(static_cast<CommandKind>(motion.command_kind)) +
            " " + motion.command_name + " for " + motion.command_source;
    if (std::isfinite(motion.command_progress)) {
      text += " (" + format_number(motion.command_progress * 100, 0) + " %)";
    }
  }
  text += "\nbalance   margin " + format_number(motion.balance_margin * 1000, 0) +
          " mm, feet carry " + format_number(robot.left_foot_force, 1) + " N left, " +
          format_number(robot.right_foot_force, 1) + " N right, stiffness " +
          format_number(motion.stiffness, 2);
  text += "\ntorso     x " + format_number(robot.position_torso_in_odometry[0], 3) + " m, y " +
          format_number(robot.position_torso_in_odometry[1], 3) + " m, height " +
          format_number(robot.position_torso_in_odometry[2], 3) + " m, heading " +
          degrees(heading_of(robot.orientation_torso_in_odometry)) + " deg";
  text += "\nvelocity  " + format_number(robot.velocity_torso_in_heading[0], 3) + " m/s ahead, " +
          format_number(robot.velocity_torso_in_heading[1], 3) + " m/s to the left, " +
          format_number(robot.angular_velocity_torso[2], 3) + " rad/s turning";
  text += "\ntime      " + format_number(static_cast<double>(robot.utime) * 1e-6, 2) + " s, tick " +
          std::to_string(robot.tick);
  if (!motion.last_refusal.empty()) text += "\nrefused   " + motion.last_refusal;
  std::vector<std::vector<std::string>> rows{{"joint", "rad", "deg", "rad/s"}};
  for (int i = 0; i < robot.num_joints; ++i) {
    rows.push_back({robot.joint_names[i], format_number(robot.joint_position[i], 3),
                    degrees(robot.joint_position[i]), format_number(robot.joint_velocity[i], 3)});
  }
  return text + "\n\n" + format_table(rows);
}

std::string to_json(const naolcm::robot_state_t& robot, const naolcm::motion_state_t& motion) {
  JsonWriter json;
  json.begin_object();
  json.add_json("robot_state", json_of(robot));
  json.begin_object("motion_state");
  json.add("utime", motion.utime);
  json.add("mode", std::string(to_string(static_cast<Mode>(motion.mode))));
  json.add("posture", motion.posture);
  json.add("command_kind", int64_t{motion.command_kind});
  json.add("command_name", motion.command_name);
  json.add("needs_help", motion.needs_help != 0);
  json.add("command_source", motion.command_source);
  json.add("command_id", motion.command_id);
  json.add("command_progress", motion.command_progress);
  json.add("balance_margin", motion.balance_margin);
  json.add("vx", motion.vx);
  json.add("vy", motion.vy);
  json.add("wz", motion.wz);
  json.add("stiffness", motion.stiffness);
  json.add("last_refusal", motion.last_refusal);
  return json.take() + "\n";
}

int run_state(const CommonOptions& common, bool as_json, bool watches) {
  EventLoop loop;
  Bus bus(common.lcm_url);
  const RobotChannels channels(common.robot);
  RobotReport report;
  bus.subscribe<naolcm::robot_state_t>(channels.robot_state, Bus::Queue::kLatest,
                                       [&report](const auto& state) { report.robot = state; });
  bus.subscribe<naolcm::motion_state_t>(channels.motion_state, Bus::Queue::kLatest,
                                        [&report](const auto& state) { report.motion = state; });
  double last_complete = monotonic_seconds();
  bool is_silent = false;
  loop.on_readable(bus.descriptor(), [&bus] { bus.handle(); });
  loop.every(watches ? 0.2 : 0.02, [&] {
    const double now = monotonic_seconds();
    if (report.is_complete()) {
      last_complete = now;
      if (watches && !as_json) clear_terminal();
      std::fputs((as_json ? to_json(*report.robot, *report.motion)
                          : to_text(*report.robot, *report.motion))
                     .c_str(),
                 stdout);
      std::fflush(stdout);
      report = {};
      if (!watches) loop.stop("end");
    } else if (now - last_complete > kListenTimeout) {
      is_silent = true;
      loop.stop("silence");
    }
  });
  loop.run();
  if (is_silent) {
    std::fprintf(stderr, "nao: no state of robot %s on %s; are nao-sim and nao-motion running?\n",
                 common.robot.c_str(), common.lcm_url.c_str());
  }
  return is_silent ? 1 : 0;
}

}  // namespace

void add_state_command(CommandLine& app, Invocation& invocation) {
  auto as_json = std::make_shared<bool>(false);
  auto watches = std::make_shared<bool>(false);
  CommandLine* state =
      app.add_subcommand("state", "Show the robot's motion state and joint angles");
  state->add_flag("--json", *as_json, "One line of JSON, fields as in the messages");
  state->add_flag("--watch", *watches, "Repeat five times a second until Ctrl-C");
  invocation.on(*state, [as_json, watches](const auto& common) {
    return run_state(common, *as_json, *watches);
  });
}

}  // namespace nao
