// Recorded joint targets and world commands, played to the simulator in lock-step: the world and
// what its robot measures must be the same, bit by bit. See README.md.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "common/channels.h"
#include "common/event_loop.h"
#include "sim/sim_daemon.h"
#include "test/playback/golden_messages.h"
#include "test/playback/golden_session.h"

namespace nao::playback {
namespace {

struct PhysicsSession {
  const char* name;
  uint64_t seed;
  int command_latency_ticks;
};

/** Names the session where GoogleTest prints a parameter. */
std::ostream& operator<<(std::ostream& stream, const PhysicsSession& session) {
  return stream << session.name;
}

/** Plays a golden session to a simulator, open loop: the joint targets are the recorded ones,
 * independent of the robot's measurements. */
class PhysicsReplay {
 public:
  explicit PhysicsReplay(const PhysicsSession& session)
      : session_(session),
        table_(golden_file(session.name, "ticks")),
        commands_(read_golden_commands(golden_file(session.name, "commands"))),
        joints_(table_.names("target_position")) {
    trace_.streams = {"world", "sensors"};
  }

  GoldenTrace run() {
    EventLoop loop;
    Bus bus("memq://");
    const RobotChannels channels;
    bus.subscribe<naolcm::sensor_state_t>(channels.sensor_state, Bus::Queue::kAll,
                                          [&](const naolcm::sensor_state_t& message) {
                                            // Both are repeated while the simulator waits for an
                                            // answer.
                                            if (message.tick <= last_sensed_tick_) return;
                                            last_sensed_tick_ = message.tick;
                                            hashes(message.tick)[1] = hash_of(message, joints_);
                                            answer(bus, message.tick, loop);
                                          });
    bus.subscribe<naolcm::world_truth_t>(
        kWorldTruthChannel, Bus::Queue::kAll, [&](const naolcm::world_truth_t& message) {
          // As it is at the end of the tick, before a world command changes it.
          if (message.tick <= last_true_tick_ || !trace_.hashes.contains(message.tick)) return;
          last_true_tick_ = message.tick;
          hashes(message.tick)[0] = hash_of(message, joints_);
        });
    sim::SimOptions options;
    options.lock_step = true;
    options.seed = session_.seed;
    options.command_latency_ticks = session_.command_latency_ticks;
    const sim::SimDaemon sim(bus, loop, options);
    loop.run();
    return trace_;
  }

 private:
  std::vector<uint64_t>& hashes(int64_t tick) {
    return trace_.hashes.try_emplace(tick, 2, 0).first->second;
  }

  void answer(Bus& bus, int64_t tick, EventLoop& loop) {
    const auto row = static_cast<size_t>(tick);
    if (row >= table_.num_rows()) {
      trace_.hashes.erase(tick);
      loop.stop("end");
      return;
    }
    while (next_command_ < commands_.size() && commands_[next_command_].tick() <= tick) {
      commands_[next_command_++].publish(bus);
    }
    bus.publish(RobotChannels().joint_command, to_joint_command(table_, row));
  }

  const PhysicsSession session_;
  const GoldenTable table_;
  const std::vector<GoldenCommand> commands_;
  const std::vector<std::string> joints_;
  size_t next_command_ = 0;
  int64_t last_sensed_tick_ = -1;
  int64_t last_true_tick_ = -1;
  GoldenTrace trace_;
};

class GoldenPhysics : public testing::TestWithParam<PhysicsSession> {};

TEST_P(GoldenPhysics, MovesTheWorldAsRecorded) {
  expect_golden_trace(GetParam().name, PhysicsReplay(GetParam()).run());
}

INSTANTIATE_TEST_SUITE_P(Playback, GoldenPhysics,
                         testing::Values(PhysicsSession{"physics-walk", 1, 1},
                                         PhysicsSession{"physics-ball", 2, 2},
                                         PhysicsSession{"physics-fall", 3, 1}),
                         [](const auto& info) {
                           // physics-walk: "walk"
                           return std::string(info.param.name).substr(8);
                         });

}  // namespace
}  // namespace nao::playback
