// Frozen logs, played to the programs that would have heard them. See README.md.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <set>
#include <string>

#include "common/data_path.h"
#include "common/error.h"
#include "daemons/motion/motion_daemon.h"
#include "test/playback/course.h"
#include "test/playback/frozen_log.h"
#include "test/playback/lock_step_run.h"
#include "test/playback/model_based.h"

namespace nao::playback {
namespace {

// Time for which a course continues after the last command, robot s.
constexpr double kAfter = 6;

std::filesystem::path session(const std::string& name) {
  return std::filesystem::path(NAO_PLAYBACK_SESSIONS) / name;
}

class Commands : public testing::TestWithParam<std::string> {};

TEST_P(Commands, TakeTheRobotAlongTheExpectedCourse) {
  const auto commands = read_frozen_log(session(GetParam() + ".commands.lcmlog"));
  const Course course = run_in_lock_step(commands, kAfter);
  const auto file = session(GetParam() + ".course");
  // test/playback/record sets it.
  if (std::getenv("NAO_WRITE_COURSES") != nullptr) {
    std::ofstream(file) << to_text(course);
    GTEST_SKIP() << "wrote " << file;
  }
  for (const std::string& difference : find_differences(read_course(file), course)) {
    ADD_FAILURE() << difference;
  }
}

TEST_P(Commands, GiveTheSameBitsEveryTime) {
  auto commands = read_frozen_log(session(GetParam() + ".commands.lcmlog"));
  commands.resize(std::min<size_t>(commands.size(), 50));
  const Course first = run_in_lock_step(commands, 1);
  const Course second = run_in_lock_step(commands, 1);
  ASSERT_FALSE(first.rows.empty());
  EXPECT_EQ(first.fingerprint, second.fingerprint);
  EXPECT_EQ(to_text(first), to_text(second));
}

INSTANTIATE_TEST_SUITE_P(Playback, Commands, testing::Values("drive", "postures"),
                         [](const auto& info) { return info.param; });

/** Output of motion for sensors alone. */
struct Reaction {
  std::vector<std::string> modes;
  std::size_t fingerprint = 0;
  int num_commands = 0;
  /** Least mean stiffness that it commanded. */
  double least_stiffness = 1;
};

Reaction react_to(const std::vector<LogEvent>& sensors) {
  EventLoop loop;
  Bus bus("memq://");
  const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  Reaction reaction;
  bus.subscribe<naolcm::joint_command_t>(
      "NAO_JOINT_COMMAND", Bus::Queue::kAll, [&](const naolcm::joint_command_t& message) {
        std::string bytes(message.getEncodedSize(), '\0');
        message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
        reaction.fingerprint = reaction.fingerprint * 31 + std::hash<std::string>()(bytes);
        ++reaction.num_commands;
      });
  bus.subscribe<naolcm::motion_state_t>(
      "NAO_MOTION_STATE", Bus::Queue::kAll, [&](const naolcm::motion_state_t& message) {
        reaction.least_stiffness = std::min(reaction.least_stiffness, message.stiffness);
        const std::string mode = to_string(static_cast<Mode>(message.mode));
        if (reaction.modes.empty() || reaction.modes.back() != mode) reaction.modes.push_back(mode);
      });
  const motion::MotionDaemon daemon(bus, loop, model, model_based(), "NAO");
  for (const LogEvent& event : sensors) {
    send(bus, event);
    while (bus.handle_for(0)) {
    }
  }
  return reaction;
}

TEST(Playback, SensorsOfAFallMakeMotionFallSoftlyTheSameEveryTime) {
  const auto sensors = read_frozen_log(session("fall.sensors.lcmlog"));
  const Reaction first = react_to(sensors);
  const Reaction second = react_to(sensors);
  EXPECT_EQ(first.num_commands, static_cast<int>(sensors.size()));
  EXPECT_EQ(first.fingerprint, second.fingerprint);
  const std::set<std::string> modes(first.modes.begin(), first.modes.end());
  EXPECT_TRUE(modes.contains("holding"));
  EXPECT_TRUE(modes.contains("falling"));
  EXPECT_LT(first.least_stiffness, 0.5);
}

TEST(Playback, ALogOfAnotherVersionIsRefusedWithASentence) {
  auto events = read_frozen_log(session("drive.commands.lcmlog"));
  // As if a field had been added since: another fingerprint.
  events[0].data[0] ^= 0xFF;
  try {
    run_in_lock_step(events, 0);
    FAIL() << "played";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("has changed since the log was frozen"),
              std::string::npos)
        << error.what();
  }
}

TEST(Playback, ACourseThatIsMissedIsTold) {
  Course expected;
  for (int i = 0; i < 20; ++i) expected.rows.push_back({0.5 * i, 0.05 * i, 0, 0, 0.32, "walking"});
  expected.results = {"posture done"};
  EXPECT_TRUE(find_differences(expected, expected).empty());
  Course slower = expected;
  for (CourseRow& row : slower.rows) row.x *= 0.9;
  EXPECT_TRUE(find_differences(expected, slower).empty()) << "a little worse is not a fault";
  Course mirrored = expected;
  for (CourseRow& row : mirrored.rows) row.x = -row.x;
  EXPECT_FALSE(find_differences(expected, mirrored).empty());
  Course fallen = expected;
  fallen.rows[10].mode = "falling";
  EXPECT_EQ(find_differences(expected, fallen).size(), 1u);
  Course lower = expected;
  for (CourseRow& row : lower.rows) row.height -= 0.03;
  EXPECT_FALSE(find_differences(expected, lower).empty());
  Course shorter = expected;
  shorter.rows.resize(5);
  EXPECT_FALSE(find_differences(expected, shorter).empty());
  Course refused = expected;
  refused.results = {"posture refused"};
  EXPECT_EQ(find_differences(expected, refused).size(), 1u);
}

}  // namespace
}  // namespace nao::playback
