// Recorded sensors and commands, played to the motion daemon: every joint command must be the same,
// bit by bit. See README.md.

#include <gtest/gtest.h>

#include <cmath>
#include <naolcm/command_result_t.hpp>
#include <set>
#include <sstream>
#include <string>

#include "common/channels.h"
#include "common/data_path.h"
#include "common/event_loop.h"
#include "daemons/motion/motion_daemon.h"
#include "test/playback/golden_messages.h"
#include "test/playback/golden_session.h"
#include "test/playback/model_based.h"

namespace nao::playback {
namespace {

/** Distance of a joint target from the recorded one, which has the table's resolution. */
struct Deviation {
  double largest = 0;  // rad
  std::string joint;
  int64_t tick = 0;
};

/** Result of a golden session in motion. */
struct MotionRun {
  GoldenTrace trace;
  Deviation deviation;
};

/** Plays a golden session to a motion daemon, open loop: the sensors are the recorded ones,
 * independent of motion's commands. */
class MotionReplay {
 public:
  explicit MotionReplay(const std::string& name)
      : table_(golden_file(name, "ticks")),
        commands_(read_golden_commands(golden_file(name, "commands"))),
        joints_(table_.names("joint_position")) {
    run_.trace.streams = {"joint_command"};
  }

  MotionRun run() {
    EventLoop loop;
    Bus bus("memq://");
    const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
    const RobotChannels channels;
    bus.subscribe<naolcm::joint_command_t>(
        channels.joint_command, Bus::Queue::kAll,
        [this](const naolcm::joint_command_t& message) { note(message); });
    bus.subscribe<naolcm::command_result_t>(
        channels.command_result, Bus::Queue::kAll,
        [this](const naolcm::command_result_t& message) { note(message); });
    const motion::MotionDaemon daemon(bus, loop, model, model_based(), "NAO");
    size_t next_command = 0;
    for (row_ = 0; row_ < table_.num_rows(); ++row_) {
      const int64_t tick = table_.tick(row_);
      while (next_command < commands_.size() && commands_[next_command].tick() <= tick) {
        commands_[next_command++].publish(bus);
      }
      bus.publish(channels.sensor_state, to_sensor_state(table_, row_));
      while (bus.handle_for(0)) {
      }
    }
    return run_;
  }

 private:
  void note(const naolcm::joint_command_t& message) {
    run_.trace.hashes[message.tick] = {hash_of(message, joints_)};
    // The next sensor state says what the servos hold: the recorded answer.
    if (row_ + 1 >= table_.num_rows() || table_.tick(row_ + 1) != message.tick + 1) return;
    const std::vector<double> recorded = table_.values(row_ + 1, "joint_target_position");
    const std::vector<double> targets = targets_of(message, joints_);
    for (size_t i = 0; i < targets.size(); ++i) {
      const double deviation = std::abs(targets[i] - recorded[i]);
      if (deviation > run_.deviation.largest) {
        run_.deviation = {deviation, joints_[i], message.tick};
      }
    }
  }

  void note(const naolcm::command_result_t& message) {
    // The end of a command is published several times.
    const std::string text = to_text(message);
    if (!known_results_.insert(text).second) return;
    run_.trace.results.push_back(std::to_string(table_.tick(row_)) + " " + text);
  }

  const GoldenTable table_;
  const std::vector<GoldenCommand> commands_;
  const std::vector<std::string> joints_;
  size_t row_ = 0;
  std::set<std::string> known_results_;
  MotionRun run_;
};

class GoldenMotion : public testing::TestWithParam<const char*> {};

TEST_P(GoldenMotion, CommandsTheJointsAsRecorded) {
  const MotionRun run = MotionReplay(GetParam()).run();
  std::ostringstream hint;
  hint << "; the largest difference of a joint target is " << run.deviation.largest << " rad ("
       << run.deviation.joint << ", tick " << run.deviation.tick
       << "), of which the recording's resolution explains up to 8e-6";
  expect_golden_trace(GetParam(), run.trace, hint.str());
}

INSTANTIATE_TEST_SUITE_P(Playback, GoldenMotion,
                         testing::Values("walk", "kicks", "falls", "postures", "joints"),
                         [](const auto& info) { return info.param; });

TEST(GoldenTrace, ADifferenceIsNamedWithItsTick) {
  GoldenTrace expected{
      {"world", "sensors"}, {{0, {1, 2}}, {1, {3, 4}}, {2, {5, 6}}}, {"1 a 7 walk done"}};
  EXPECT_TRUE(find_differences(expected, expected).empty());
  GoldenTrace trace = expected;
  trace.hashes[1][1] = 0;
  trace.hashes.erase(2);
  trace.results[0] = "2 a 7 walk done";
  const std::vector<std::string> differences = find_differences(expected, trace);
  ASSERT_EQ(differences.size(), 3u);
  EXPECT_EQ(differences[0], "world: 1 of 3 ticks differ, the first is tick 2");
  EXPECT_EQ(differences[1], "sensors: 2 of 3 ticks differ, the first is tick 1");
  EXPECT_EQ(differences[2], "result 0: \"2 a 7 walk done\", expected \"1 a 7 walk done\"");
}

}  // namespace
}  // namespace nao::playback
