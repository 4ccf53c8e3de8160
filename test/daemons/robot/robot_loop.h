#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "common/data_path.h"
#include "daemons/motion/message_conversion.h"
#include "daemons/motion/motion_core.h"
#include "daemons/robot/robot_core.h"
#include "daemons/robot/robot_messages.h"
#include "lola/codec.h"
#include "sim/sim_core.h"
#include "test/daemons/robot/lola_nao.h"

namespace nao::robot {

inline sim::SimOptions loop_sim_options(uint64_t seed, const std::string& disturbances) {
  sim::SimOptions options;
  options.scene = "empty";
  options.lola_socket = "none";
  options.lock_step = true;
  options.tick_ms = 12;
  options.disturbances = disturbances;
  options.seed = seed;
  return options;
}

/** The simulator behind LoLA, nao-robot's core and nao-motion's core in one process, with the
 * frames' bytes between the first two: the programs of a real robot, without clock and socket. */
class RobotLoop {
 public:
  /** @param disturbances  As in nao-sim's --disturbances. */
  explicit RobotLoop(uint64_t seed = 1, const std::string& disturbances = "")
      : sim_(loop_sim_options(seed, disturbances)), motion_(nao_model(), motion::MotionOptions{}) {}

  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.012); ++i) frame();
  }
  bool run_until(const std::function<bool()>& condition, double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.012); ++i) {
      if (condition()) return true;
      frame();
    }
    return condition();
  }

  void frame() {
    // The robot's frame, as bytes.
    std::array<uint8_t, kLolaStateBytes> state_bytes;
    ASSERT_EQ(encode(sim_.lola()->state(), state_bytes), kLolaStateBytes);
    LolaState state;
    ASSERT_EQ(decode(state_bytes, state).status, LolaDecoding::Status::kDone);
    core_->take_frame(state, num_frames_ == 0 ? 0 : 1);
    const int64_t utime = 12000 * num_frames_++;
    // nao-motion.
    bool has_command = false;
    if (has_motion) {
      motion::Input input;
      input.sensors = motion::to_sensors(nao_model(), messages_.sensor_state(*core_, utime));
      input.commands = std::exchange(commands_, {});
      const motion::Output output = motion_.step(input, 0.012);
      for (const CommandResult& result : output.results) last_status_ = result.status;
      if (output.joint_targets) {
        command_.position = output.joint_targets->position;
        command_.stiffness = output.joint_targets->stiffness;
        has_command = true;
      }
    }
    // The answer, as bytes.
    const LolaCommand& answer = core_->step({has_command ? &command_ : nullptr, false, is_ending});
    check_speed();
    std::array<uint8_t, kLolaCommandBytes> answer_bytes;
    const size_t size = encode(answer, answer_bytes);
    LolaCommand command;
    ASSERT_EQ(decode(std::span(answer_bytes).first(size), command).status,
              LolaDecoding::Status::kDone);
    sim_.take_lola_command(command, 0);
    sim_.run_tick(0);
  }

  template <class Request>
  void send(Request request) {
    Command command;
    command.source = "test";
    command.id = ++last_id_;
    command.request = std::move(request);
    commands_.push_back(command);
    last_status_ = ResultStatus::kAccepted;
  }
  /** Repeats a walk command for some time. */
  void walk(double vx, double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.096); ++i) {
      send(WalkCommand{vx, 0, 0});
      run(0.096);
    }
  }
  void place_lying() { place("LyingBack"); }
  void place(const std::string& posture) {
    sim::WorldCommand command;
    command.source = "test";
    command.id = ++last_id_;
    command.name = "place-robot";
    command.posture = posture;
    command.orientation.setZero();
    ASSERT_TRUE(sim_.take_world_command(command, 0));
    ASSERT_EQ(sim_.last_world_command().error, "");
  }

  /** The program dies and the watchdog's core takes over; the servos keep what they have. */
  void crash(int num_frames_later) {
    // The new program continues from what the servos hold.
    last_targets_.clear();
    for (int i = 0; i < num_frames_later; ++i) {
      sim_.take_lola_command({}, 0);
      sim_.run_tick(0);
    }
    core_.emplace(nao_model(), nao_map(), false);
    has_motion = false;
    is_ending = true;
    num_frames_ = 0;
  }
  /** After crash(): the program is restarted, and motion runs. */
  void restart() {
    last_targets_.clear();
    core_.emplace(nao_model(), nao_map(), true);
    has_motion = true;
    is_ending = false;
    num_frames_ = 0;
  }

  double height() const { return sim_.world().robot(0).state().position.z(); }
  Eigen::Vector3d position() const { return sim_.world().robot(0).state().position; }
  double tilt() const {
    const Eigen::Vector3d up =
        sim_.world().robot(0).state().orientation.conjugate() * Eigen::Vector3d::UnitZ();
    return std::acos(std::clamp(up.z(), -1.0, 1.0));
  }
  /** Upright on the heels, and limp. */
  bool is_seated() const { return tilt() < 0.4 && height() < 0.26 && is_limp(); }
  bool is_limp() const {
    const auto& stiffness = sim_.lola()->state().stiffness;
    return *std::max_element(stiffness.begin(), stiffness.end()) <= 0.15f;
  }

  /** Joint targets that changed faster than their motor turns, in all frames so far. */
  int num_too_fast() const { return num_too_fast_; }
  const RobotCore& core() const { return *core_; }
  ResultStatus last_status() const { return last_status_; }

  bool has_motion = true;
  bool is_ending = false;

 private:
  void check_speed() {
    const std::vector<double>& targets = core_->targets().position;
    for (size_t i = 0; i < last_targets_.size(); ++i) {
      const double limit = nao_model().motor_joint(static_cast<int>(i)).max_velocity * 0.012;
      if (std::abs(targets[i] - last_targets_[i]) > 1.001 * limit) ++num_too_fast_;
    }
    last_targets_ = targets;
  }

  sim::SimCore sim_;
  motion::MotionCore motion_;
  std::optional<RobotCore> core_{std::in_place, nao_model(), nao_map(), true};
  RobotMessages messages_{nao_model(), nao_map()};
  Targets command_;
  std::vector<Command> commands_;
  int64_t num_frames_ = 0;
  int64_t last_id_ = 0;
  /** Targets of the last frame; empty before the first one. */
  std::vector<double> last_targets_;
  int num_too_fast_ = 0;
  ResultStatus last_status_ = ResultStatus::kAccepted;
};

/** Makes the robot stand: it is driven, and sits first. */
inline void stand(RobotLoop& loop) {
  ASSERT_TRUE(loop.run_until([&] { return loop.core().safety().phase() == Phase::kDriven; }, 12));
  loop.run(0.3);
  loop.send(PostureCommand{"StandInit", 0.5});
  loop.run(0.1);
  ASSERT_TRUE(loop.run_until([&] { return loop.last_status() == ResultStatus::kDone; }, 15));
  ASSERT_GT(loop.height(), 0.3);
}

}  // namespace nao::robot
