// The whole program: its messages and its exit status.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/data_path.h"
#include "common/wall_clock.h"
#include "test/daemons/head-camera/running_camera.h"
#include "test/daemons/head-camera/truth.h"
#include "test/support/child_program.h"
#include "test/support/num_waits.h"

namespace nao {
namespace {

struct Outcome {
  int status;
  std::string text;
};

/** Runs a command line until it ends. */
Outcome run(const std::string& command) {
  Outcome outcome{-1, ""};
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 512> line{};
  while (fgets(line.data(), line.size(), pipe) != nullptr) outcome.text += line.data();
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

TEST(HeadCameraProgram, ReportsAMissingOpenGlDriver) {
  // Without a vendor library the EGL dispatcher finds no driver.
  const Outcome outcome = run("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent timeout 60 " +
                              camera_program() + " --lcm-url '" + private_url() + "'");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.text, testing::HasSubstr("no OpenGL without a screen"));
  EXPECT_THAT(outcome.text, testing::HasSubstr("libegl-mesa0"));
}

TEST(HeadCameraProgram, RejectsAWrongCommandLine) {
  EXPECT_EQ(run(camera_program() + " --wide").status, 2);
  const Outcome size = run(camera_program() + " --always --width 641");
  EXPECT_EQ(size.status, 1);
  EXPECT_THAT(size.text, testing::HasSubstr("640, 320 or 160"));
  const Outcome camera = run(camera_program() + " --always --camera tail");
  EXPECT_EQ(camera.status, 1);
  EXPECT_THAT(camera.text, testing::HasSubstr("its cameras are: top, bottom"));
  const Outcome distortion = run(camera_program() + " --p1 3");
  EXPECT_EQ(distortion.status, 1);
  EXPECT_THAT(distortion.text, testing::HasSubstr("outside -2 to 2"));
  const Outcome file = run(camera_program() + " --source v4l2 --lcm-url '" + private_url() + "'");
  EXPECT_EQ(file.status, 1);
  EXPECT_THAT(file.text, testing::HasSubstr("head_cameras.yaml"));
  const Outcome device = run(camera_program() + " --source v4l2 --device tail=/dev/video0");
  EXPECT_EQ(device.status, 1);
  EXPECT_THAT(device.text, testing::HasSubstr("its cameras are: top, bottom"));
  EXPECT_EQ(run(camera_program() + " --source film").status, 2);
  const Outcome platform =
      run(camera_program() + " --egl-platform moon --lcm-url '" + private_url() + "'");
  EXPECT_EQ(platform.status, 1);
  EXPECT_THAT(platform.text, testing::HasSubstr("moon"));
}

/** Sends a state of the world every 10 ms and handles what comes, until `num_images` reaches
 * `least` or a minute is over. @return Number of states. */
int send_states(Bus& bus, naolcm::world_truth_t& truth, const size_t& num_images, size_t least) {
  int num_states = 0;
  const double end = monotonic_seconds() + 60;
  for (; num_images < least && monotonic_seconds() < end; ++num_states) {
    truth.utime += 10000;
    bus.publish(kWorldTruthChannel, truth);
    const double next = monotonic_seconds() + 0.01;
    while (monotonic_seconds() < next) bus.handle_for(0.002);
  }
  return num_states;
}

TEST(HeadCameraProgram, SendsImagesInOrderAndEndsOnSigterm) {
  const std::string url = private_url();
  Bus bus(url);
  std::vector<int64_t> utimes;
  size_t num_images = 0;
  std::string state;
  bus.subscribe<naolcm::image_t>("NAO_HEAD_CAMERA_IMAGE", Bus::Queue::kAll,
                                 [&](const naolcm::image_t& image) {
                                   utimes.push_back(image.utime);
                                   ++num_images;
                                 });
  bus.subscribe<naolcm::daemon_status_t>(
      kDaemonStatusChannel, Bus::Queue::kAll,
      [&](const naolcm::daemon_status_t& status) { state = status.state; });
  const auto model = RobotModel::load(data_path() / "robots" / "nao");
  naolcm::world_truth_t truth = make_truth(model, "StandInit", 0.32);

  RunningCamera camera({"--always", "--rate", "30", "--lcm-url", url});
  send_states(bus, truth, num_images, 20);
  ASSERT_GE(utimes.size(), 20u);
  EXPECT_EQ(state, "ready");
  for (size_t i = 1; i < utimes.size(); ++i) EXPECT_GT(utimes[i], utimes[i - 1]);
  EXPECT_LE(utimes.back(), truth.utime);
  EXPECT_EQ(camera.stop(), 0);
}

TEST(HeadCameraProgram, IsWokenForImagesAndNotByStates) {
  const std::string url = private_url();
  Bus bus(url);
  size_t num_images = 0;
  bus.subscribe<naolcm::image_t>("NAO_HEAD_CAMERA_IMAGE", Bus::Queue::kAll,
                                 [&](const naolcm::image_t&) { ++num_images; });
  const auto model = RobotModel::load(data_path() / "robots" / "nao");
  naolcm::world_truth_t truth = make_truth(model, "StandInit", 0.32);
  ChildProgram camera("nao-head-camera", {"--always", "--rate", "10", "--lcm-url", url});
  send_states(bus, truth, num_images, 5);
  const int before = num_waits(camera.pid());
  const int num_states = send_states(bus, truth, num_images, 15);
  ASSERT_GE(num_images, 15u);
  EXPECT_LT(num_waits(camera.pid()) - before, num_states);
}

}  // namespace
}  // namespace nao
