#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <naolcm/world_truth_t.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/json_writer.h"
#include "common/wall_clock.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/text_table.h"

namespace nao {
namespace {

/** Angle between the torso's z axis and the vertical, rad, from a unit quaternion (w, x, y, z). */
double tilt_of(const double* q) {
  return std::acos(std::clamp(1 - 2 * (q[1] * q[1] + q[2] * q[2]), -1.0, 1.0));
}

std::string point_text(const double* point) {
  return "x " + format_number(point[0], 3) + " m, y " + format_number(point[1], 3) + " m, z " +
         format_number(point[2], 3) + " m";
}

std::string to_text(const naolcm::world_truth_t& truth) {
  std::string text = "scene " + truth.scene + ", " + (truth.is_paused != 0 ? "paused" : "running") +
                     ", " + format_number(truth.real_time_factor, 3) + " times real time, at " +
                     format_number(static_cast<double>(truth.utime) * 1e-6, 2) + " s\n";
  text += "late: " + std::to_string(truth.num_late_ticks) + " ticks, " +
          std::to_string(truth.num_late_commands) + " joint commands\n";
  for (const naolcm::robot_truth_t& robot : truth.robots) {
    text += robot.robot;
    if (robot.number != 0) {
      text +=
          " (team " + std::to_string(robot.team) + ", number " + std::to_string(robot.number) + ")";
    }
    text += "  torso " + point_text(robot.position_torso_in_world) + ", tilt " +
            format_number(tilt_of(robot.orientation_torso_in_world) * 180 / std::numbers::pi, 1) +
            " deg\n";
  }
  if (truth.has_ball != 0) text += "ball " + point_text(truth.position_ball_in_world) + "\n";
  return text;
}

std::string to_json(const naolcm::world_truth_t& truth) {
  JsonWriter json;
  json.begin_object();
  json.add("utime", truth.utime);
  json.add("tick", truth.tick);
  json.add("scene", truth.scene);
  json.add("is_paused", truth.is_paused != 0);
  json.add("real_time_factor", truth.real_time_factor);
  json.add("pace", truth.pace);
  json.add("num_late_commands", truth.num_late_commands);
  json.add("num_late_ticks", truth.num_late_ticks);
  json.begin_array("robots");
  for (const naolcm::robot_truth_t& robot : truth.robots) {
    json.begin_object();
    json.add("robot", robot.robot);
    json.add("model", robot.model);
    json.add("team", robot.team);
    json.add("number", robot.number);
    json.add("position_torso_in_world", robot.position_torso_in_world, 3);
    json.add("orientation_torso_in_world", robot.orientation_torso_in_world, 4);
    json.add("velocity_torso_in_world", robot.velocity_torso_in_world, 3);
    json.add("center_of_mass_in_world", robot.center_of_mass_in_world, 3);
    json.begin_array("joint_names");
    for (const std::string& name : robot.joint_names) json.add("", name);
    json.end();
    json.add("joint_position", robot.joint_position.data(), robot.num_joints);
    json.add("joint_torque", robot.joint_torque.data(), robot.num_joints);
    json.begin_array("light_names");
    for (const std::string& name : robot.light_names) json.add("", name);
    json.end();
    json.begin_array("light_rgb");
    for (const std::vector<double>& rgb : robot.light_rgb) json.add("", rgb.data(), 3);
    json.end();
    json.end();
  }
  json.end();
  json.add("has_ball", truth.has_ball != 0);
  json.add("position_ball_in_world", truth.position_ball_in_world, 3);
  json.add("velocity_ball_in_world", truth.velocity_ball_in_world, 3);
  json.add("num_contacts", truth.num_contacts);
  return json.take() + "\n";
}

int run_show(const CommonOptions& common, bool as_json) {
  Bus bus(common.lcm_url);
  std::optional<naolcm::world_truth_t> truth;
  bus.subscribe<naolcm::world_truth_t>(kWorldTruthChannel, Bus::Queue::kLatest,
                                       [&truth](const auto& message) { truth = message; });
  const double start = monotonic_seconds();
  while (!truth && monotonic_seconds() - start < kListenTimeout) bus.handle_for(0.1);
  if (!truth) {
    std::fprintf(stderr, "nao: no simulated world on %s; is nao-sim running?\n",
                 common.lcm_url.c_str());
    return 1;
  }
  std::fputs((as_json ? to_json(*truth) : to_text(*truth)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_show_command(CommandLine& world, Invocation& invocation) {
  auto as_json = std::make_shared<bool>(false);
  CommandLine* show = world.add_subcommand("show", "Show the true state of the simulated world");
  show->add_flag("--json", *as_json, "One line of JSON, fields as in world_truth_t");
  invocation.on(*show, [as_json](const auto& common) { return run_show(common, *as_json); });
}

}  // namespace nao
