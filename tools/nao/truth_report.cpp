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
#include "common/wall_clock.h"
#include "inspection/message_json.h"
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
  std::fputs((as_json ? json_of(*truth) + "\n" : to_text(*truth)).c_str(), stdout);
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
