// Simulator and motion in lock-step under random commands and pushes: every joint command and the
// whole world must be the same, bit by bit, as when the expected hashes were written. See
// README.md.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <naolcm/command_result_t.hpp>
#include <set>
#include <sstream>
#include <string>

#include "common/channels.h"
#include "common/data_path.h"
#include "common/event_loop.h"
#include "daemons/motion/motion_daemon.h"
#include "sim/sim_daemon.h"
#include "test/playback/golden_hash.h"
#include "test/playback/golden_messages.h"
#include "test/playback/golden_session.h"
#include "test/playback/model_based.h"

namespace nao::playback {
namespace {

constexpr int64_t kNumTicks = 4000;     // 40 s
constexpr int64_t kTicksPerHash = 100;  // a line of the expected trace
constexpr int64_t kFirstCommand = 50;   // tick
constexpr int64_t kTicksPerWalk = 20;   // between repetitions of a walk command

/** SplitMix64 (Steele, Lea, Flood, OOPSLA 2014). */
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  /** Uniform in [low, high), in thousandths, so that its decimal text is short. */
  double number(double low, double high) {
    state_ += 0x9e3779b97f4a7c15u;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    const double unit = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    return std::floor((low + (high - low) * unit) * 1000) / 1000;
  }
  template <size_t N>
  const char* one_of(const std::array<const char*, N>& list) {
    return list[static_cast<size_t>(number(0, N))];
  }

 private:
  uint64_t state_;
};

/** Random commands of all kinds and pushes, from a seed, as lines of a golden session. */
class RandomCommands {
 public:
  explicit RandomCommands(uint64_t seed) : random_(seed) {
    for (int64_t tick = kFirstCommand; tick < kNumTicks;) tick += add_at(tick);
  }

  std::vector<GoldenCommand> take() { return std::move(commands_); }

 private:
  /** @return Ticks until the next command. */
  int64_t add_at(int64_t tick) {
    constexpr std::array kPostures{"StandZero", "StandInit", "Stand",     "Crouch",
                                   "Sit",       "SitRelax",  "LyingBack", "LyingBelly"};
    constexpr std::array kActions{"kick-left",  "kick-right", "block", "dive-left",
                                  "dive-right", "wave",       "get-up"};
    constexpr std::array kJoints{"HeadYaw",      "HeadPitch",    "LShoulderPitch", "RShoulderRoll",
                                 "LElbowRoll",   "RHipPitch",    "LKneePitch",     "RAnkleRoll",
                                 "LHipYawPitch", "LShoulderRoll"};
    const double kind = random_.number(0, 12);
    std::ostringstream text;
    if (kind < 5) return add_walk(tick);
    if (kind < 6) {
      text << R"("type": "posture", "posture": ")" << random_.one_of(kPostures) << R"(", "speed": )"
           << random_.number(0.2, 1);
    } else if (kind < 7) {
      text << R"("type": "move-to", "x": )" << random_.number(-0.3, 0.3) << R"(, "y": )"
           << random_.number(-0.2, 0.2) << R"(, "theta": )" << random_.number(-1, 1);
    } else if (kind < 8) {
      text << R"("type": "action", "action": ")" << random_.one_of(kActions) << '"';
    } else if (kind < 10.5) {
      text << R"("type": "joint-change", "joint_names": [")" << random_.one_of(kJoints)
           << R"("], "joint_position": [)" << random_.number(-1, 1) << R"(], "is_relative": true)"
           << R"(, "speed": )" << random_.number(0.1, 1);
    } else if (kind < 11) {
      text << R"("type": "stop")";
    } else {
      text << R"("type": "world", "command": "push", "link": "torso", "impulse": [)"
           << random_.number(-3, 3) << ", " << random_.number(-3, 3) << ", 0]";
    }
    add(tick, ++last_id_, text.str());
    return static_cast<int64_t>(random_.number(20, 400));
  }

  int64_t add_walk(int64_t tick) {
    std::ostringstream text;
    text << R"("type": "walk", "vx": )" << random_.number(-0.15, 0.3) << R"(, "vy": )"
         << random_.number(-0.1, 0.1) << R"(, "wz": )" << random_.number(-0.8, 0.8);
    const auto length = static_cast<int64_t>(random_.number(50, 400));
    const int64_t id = ++last_id_;
    for (int64_t after = 0; after < length; after += kTicksPerWalk)
      add(tick + after, id, text.str());
    return length;
  }

  void add(int64_t tick, int64_t id, const std::string& rest) {
    std::ostringstream line;
    line << R"({"tick": )" << tick << R"(, "source": "golden", "id": )" << id << ", " << rest
         << "}";
    commands_.emplace_back(line.str());
  }

  Random random_;
  int64_t last_id_ = 0;
  std::vector<GoldenCommand> commands_;
};

/** A run of simulator and motion under commands. */
class ClosedLoop {
 public:
  explicit ClosedLoop(uint64_t seed) : seed_(seed), commands_(RandomCommands(seed).take()) {
    trace_.streams = {"joint_command", "world"};
  }

  GoldenTrace run() {
    EventLoop loop;
    // This loop never runs: the motion daemon must do nothing by the wall clock.
    EventLoop motion_loop;
    Bus bus("memq://");
    const RobotChannels channels;
    const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
    for (int motor = 0; motor < model.num_motors(); ++motor) {
      joints_.push_back(model.motor_joint(motor).name);
    }
    // This subscribes first, so that motion has a command before the sensors.
    bus.subscribe<naolcm::sensor_state_t>(
        channels.sensor_state, Bus::Queue::kAll, [&](const naolcm::sensor_state_t& message) {
          if (message.tick >= kNumTicks) loop.stop("end");
          while (next_command_ < commands_.size() &&
                 commands_[next_command_].tick() <= message.tick) {
            commands_[next_command_++].publish(bus);
          }
        });
    // Each is published again while the simulator waits.
    bus.subscribe<naolcm::joint_command_t>(channels.joint_command, Bus::Queue::kAll,
                                           [this](const naolcm::joint_command_t& message) {
                                             note(message.tick, 0, hash_of(message, joints_));
                                           });
    bus.subscribe<naolcm::world_truth_t>(kWorldTruthChannel, Bus::Queue::kAll,
                                         [this](const naolcm::world_truth_t& message) {
                                           note(message.tick, 1, hash_of(message, joints_));
                                         });
    bus.subscribe<naolcm::command_result_t>(
        channels.command_result, Bus::Queue::kAll,
        [this](const naolcm::command_result_t& message) { note(message); });
    const motion::MotionDaemon motion(bus, motion_loop, model, model_based(), "NAO");
    sim::SimOptions options;
    options.lock_step = true;
    options.seed = seed_;
    const sim::SimDaemon sim(bus, loop, options);
    loop.run();
    return trace_;
  }

 private:
  void note(int64_t tick, size_t stream, uint64_t hash) {
    if (tick <= last_tick_[stream] || tick >= kNumTicks) return;
    last_tick_[stream] = tick;
    hashes_[stream].add(hash);
    if (tick % kTicksPerHash != 0) return;
    trace_.hashes.try_emplace(tick, 2, 0).first->second[stream] = hashes_[stream].value();
  }

  void note(const naolcm::command_result_t& message) {
    if (last_tick_[0] >= kNumTicks - 1) return;
    // The end of a command is published several times.
    const std::string text = to_text(message);
    if (!known_results_.insert(text).second) return;
    trace_.results.push_back(std::to_string(last_tick_[0]) + " " + text);
  }

  const uint64_t seed_;
  const std::vector<GoldenCommand> commands_;
  std::vector<std::string> joints_;
  size_t next_command_ = 0;
  std::array<int64_t, 2> last_tick_{-1, -1};
  std::array<GoldenHash, 2> hashes_;
  std::set<std::string> known_results_;
  GoldenTrace trace_;
};

class GoldenClosedLoop : public testing::TestWithParam<uint64_t> {};

TEST_P(GoldenClosedLoop, GoesAsRecorded) {
  expect_golden_trace("closed-loop-" + std::to_string(GetParam()), ClosedLoop(GetParam()).run(),
                      " (each hash covers all ticks before it)");
}

INSTANTIATE_TEST_SUITE_P(Playback, GoldenClosedLoop, testing::Values(1, 2, 3, 4),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace nao::playback
