// The whole program, without a screen.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "common/data_path.h"
#include "robot_model/robot_model.h"
#include "test/daemons/head-camera/truth.h"
#include "test/support/decimal_comma.h"
#include "test/support/read_png.h"
#include "test/support/temporary_folder.h"

namespace nao::viewer {
namespace {

class ViewerProgram : public testing::Test {
 protected:
  struct Outcome {
    int status;
    std::string text;
  };

  /** @param environment  Further variables: "NAME=VALUE". */
  static Outcome run(const std::string& arguments, const std::string& environment = "") {
    const std::filesystem::path program =
        std::filesystem::canonical("/proc/self/exe").parent_path() / "nao-viewer";
    const std::string url =
        "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
    const std::string command = "env -u DISPLAY -u WAYLAND_DISPLAY LCM_DEFAULT_URL='" + url + "' " +
                                environment + " timeout 100 " + program.string() + " " + arguments +
                                " 2>&1";
    Outcome outcome{-1, ""};
    FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 512> line{};
    while (fgets(line.data(), line.size(), pipe) != nullptr) outcome.text += line.data();
    outcome.status = WEXITSTATUS(pclose(pipe));
    return outcome;
  }

  /** Ten seconds of a robot that stands for five seconds and then lies. */
  std::string make_log() const {
    const std::filesystem::path file = folder_.path() / "test.log";
    const auto model = RobotModel::load(data_path() / "robots" / "nao");
    lcm::LogFile log(file.string(), "w");
    naolcm::world_truth_t truth = make_truth(model, "StandInit", 0.32);
    for (int i = 0; i < 100; ++i) {
      truth.utime = 100000 * i;
      if (i == 50) {
        truth.robots[0].position_torso_in_world[2] = 0.06;
        truth.robots[0].orientation_torso_in_world[0] = 0.7071068;
        truth.robots[0].orientation_torso_in_world[2] = 0.7071068;
      }
      std::vector<uint8_t> data(truth.getEncodedSize());
      truth.encode(data.data(), 0, static_cast<int>(data.size()));
      lcm::LogEvent event;
      event.eventnum = i;
      event.timestamp = 1700000000000000 + 100000 * i;
      event.channel = "WORLD_TRUTH";
      event.datalen = static_cast<int32_t>(data.size());
      event.data = data.data();
      log.writeEvent(&event);
    }
    return file.string();
  }

  static int count_different(const Image& a, const Image& b) {
    int count = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i) count += std::abs(a.rgb[i] - b.rgb[i]) > 20 ? 1 : 0;
    return count;
  }

  const TemporaryFolder folder_;
};

TEST_F(ViewerProgram, StartsBeforeAnythingElseAndDrawsWithoutAScreen) {
  const std::string file = folder_.path() / "empty.png";
  const Outcome outcome = run("--offscreen --frames 3 --screenshot " + file);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  const Image image = read_png(file);
  EXPECT_EQ(image.width, 1280);
  EXPECT_EQ(image.height, 800);
}

TEST_F(ViewerProgram, ShowsAnyTimeOfALog) {
  const std::string log = make_log();
  const auto shot = [&](const std::string& name, double time, const std::string& environment = "") {
    const std::string file = folder_.path() / name;
    const Outcome outcome =
        run("--log " + log + " --paused --log-start " + std::to_string(time) +
                " --offscreen --no-panels --width 320 --height 240 --frames 2 --screenshot " + file,
            environment);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return read_png(file);
  };
  const Image standing = shot("standing.png", 2);
  const Image lying = shot("lying.png", 8);
  EXPECT_EQ(count_different(standing, shot("again.png", 4)), 0);
  EXPECT_GT(count_different(standing, lying), 1000);
  if (!make_decimal_comma(folder_.path())) GTEST_SKIP() << "no localedef: install locales";
  const std::string comma =
      "LOCPATH=" + folder_.path().string() + " LC_ALL=" + std::string(kDecimalComma);
  EXPECT_EQ(count_different(lying, shot("comma.png", 7.5, comma)), 0);
}

TEST_F(ViewerProgram, ReportsMissingScreensAndWrongFiles) {
  const Outcome display = run("");
  EXPECT_EQ(display.status, 1);
  EXPECT_THAT(display.text, testing::HasSubstr("DISPLAY"));
  EXPECT_THAT(display.text, testing::HasSubstr("--offscreen"));
  const std::string text = folder_.path() / "text.log";
  write_text(text, "no log");
  const Outcome log = run("--offscreen --screenshot a.png --log " + text);
  EXPECT_EQ(log.status, 1);
  EXPECT_THAT(log.text, testing::HasSubstr("not a log of lcm-logger"));
  EXPECT_EQ(run("--log /nonexistent.log").status, 2);
}

}  // namespace
}  // namespace nao::viewer
