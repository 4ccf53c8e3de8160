#include "test/playback/lock_step_run.h"

#include <cmath>
#include <functional>
#include <naolcm/command_result_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "common/bus.h"
#include "common/channels.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "daemons/motion/motion_daemon.h"
#include "sim/sim_daemon.h"
#include "test/playback/frozen_log.h"
#include "test/playback/model_based.h"

namespace nao::playback {
namespace {

constexpr int64_t kTicksPerRow = 50;
constexpr double kTick = 0.01;  // s

double heading_of(const double* q) {
  return std::atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] * q[2] + q[3] * q[3]));
}

/** Listens to a run and records its course. */
class CourseWriter {
 public:
  /** @param end  Robot time, microseconds, from which on nothing counts: the loop does not end at
   * once. */
  CourseWriter(Bus& bus, const RobotChannels& channels, int64_t end) : end_(end) {
    bus.subscribe<naolcm::motion_state_t>(
        channels.motion_state, Bus::Queue::kAll,
        [this](const auto& message) { mode_ = to_string(static_cast<Mode>(message.mode)); });
    bus.subscribe<naolcm::command_result_t>(
        channels.command_result, Bus::Queue::kAll,
        [this](const naolcm::command_result_t& message) { note(message); });
    bus.subscribe<naolcm::world_truth_t>(
        kWorldTruthChannel, Bus::Queue::kAll,
        [this](const naolcm::world_truth_t& message) { note(message); });
    bus.subscribe<naolcm::joint_command_t>(
        channels.joint_command, Bus::Queue::kAll,
        [this](const naolcm::joint_command_t& message) { note(message); });
  }

  const Course& course() const { return course_; }

 private:
  void note(const naolcm::command_result_t& message) {
    // Walks are replaced by one another many times a second, and a result is repeated as long as
    // its command is.
    if (message.command_kind == message.COMMAND_KIND_WALK ||
        message.status == message.STATUS_ACCEPTED) {
      return;
    }
    const auto key = std::make_pair(message.source, message.command_id);
    if (!known_results_.insert(key).second) return;
    course_.results.push_back(
        std::string(to_string(static_cast<CommandKind>(message.command_kind))) + " " +
        to_string(static_cast<ResultStatus>(message.status)));
  }

  void note(const naolcm::world_truth_t& message) {
    if (message.tick == last_tick_ || message.tick % kTicksPerRow != 0 || message.utime > end_)
      return;
    last_tick_ = message.tick;
    const naolcm::robot_truth_t& robot = message.robots.at(0);
    CourseRow row;
    row.time = static_cast<double>(message.tick) * kTick;
    row.x = robot.position_torso_in_world[0];
    row.y = robot.position_torso_in_world[1];
    row.height = robot.position_torso_in_world[2];
    row.heading = heading_of(robot.orientation_torso_in_world);
    if (!course_.rows.empty()) {
      const double last = course_.rows.back().heading;
      row.heading = last + std::remainder(row.heading - last, 2 * M_PI);
    }
    row.mode = mode_;
    course_.rows.push_back(row);
  }

  void note(const naolcm::joint_command_t& message) {
    // An answer is repeated when the simulator has waited for it for a long time.
    if (message.tick <= last_answered_tick_ || message.utime >= end_) return;
    last_answered_tick_ = message.tick;
    std::string bytes(message.getEncodedSize(), '\0');
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    course_.fingerprint = course_.fingerprint * 31 + std::hash<std::string_view>()(bytes);
  }

  Course course_;
  std::string mode_ = "no-robot";
  std::set<std::pair<std::string, int64_t>> known_results_;
  int64_t last_tick_ = -1;
  int64_t last_answered_tick_ = -1;
  int64_t end_;
};

}  // namespace

Course run_in_lock_step(const std::vector<LogEvent>& commands, double after) {
  EventLoop loop;
  Bus bus("memq://");
  const RobotChannels channels;
  const int64_t end = commands.back().wall_utime + static_cast<int64_t>(after * 1e6);
  size_t next = 0;
  std::string fault;
  // First of all subscribers, so that motion has the command before it has the sensors.
  bus.subscribe<naolcm::sensor_state_t>(
      channels.sensor_state, Bus::Queue::kAll, [&](const naolcm::sensor_state_t& message) {
        try {
          while (next < commands.size() && commands[next].wall_utime <= message.utime) {
            send(bus, commands[next++]);
          }
        } catch (const Error& error) {
          fault = error.what();
        }
        if (!fault.empty() || message.utime >= end) loop.stop("end");
      });
  const CourseWriter writer(bus, channels, end);
  const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  const motion::MotionDaemon motion(bus, loop, model, model_based(), "NAO");
  sim::SimOptions options;
  options.lock_step = true;
  const sim::SimDaemon sim(bus, loop, options);
  loop.run();
  if (!fault.empty()) throw Error(fault);
  return writer.course();
}

}  // namespace nao::playback
