// The whole program: its messages and its exit status.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

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
#include "test/daemons/head-camera/truth.h"

namespace nao {
namespace {

std::string program() {
  return std::filesystem::canonical("/proc/self/exe").parent_path() / "nao-head-camera";
}

/** A bus that only this process uses. */
std::string private_url() {
  return "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
}

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
                              program() + " --lcm-url '" + private_url() + "'");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.text, testing::HasSubstr("no OpenGL without a screen"));
  EXPECT_THAT(outcome.text, testing::HasSubstr("libegl-mesa0"));
}

TEST(HeadCameraProgram, RejectsAWrongCommandLine) {
  EXPECT_EQ(run(program() + " --wide").status, 2);
  const Outcome size = run(program() + " --always --width 641");
  EXPECT_EQ(size.status, 1);
  EXPECT_THAT(size.text, testing::HasSubstr("640, 320 or 160"));
  const Outcome camera = run(program() + " --always --camera tail");
  EXPECT_EQ(camera.status, 1);
  EXPECT_THAT(camera.text, testing::HasSubstr("its cameras are: top, bottom"));
  const Outcome distortion = run(program() + " --p1 3");
  EXPECT_EQ(distortion.status, 1);
  EXPECT_THAT(distortion.text, testing::HasSubstr("outside -2 to 2"));
  const Outcome platform =
      run(program() + " --egl-platform moon --lcm-url '" + private_url() + "'");
  EXPECT_EQ(platform.status, 1);
  EXPECT_THAT(platform.text, testing::HasSubstr("moon"));
}

/** The program, running during the lifetime of this object. */
class RunningCamera {
 public:
  explicit RunningCamera(const std::string& url) : process_(fork()) {
    if (process_ != 0) return;
    const std::string name = program();
    execl(name.c_str(), name.c_str(), "--always", "--rate", "30", "--lcm-url", url.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
  }
  ~RunningCamera() {
    if (process_ > 0) stop();
  }

  /** Sends SIGTERM. @return The exit status. */
  int stop() {
    kill(process_, SIGTERM);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_;
};

TEST(HeadCameraProgram, SendsImagesInOrderAndEndsOnSigterm) {
  const std::string url = private_url();
  Bus bus(url);
  std::vector<int64_t> utimes;
  std::string state;
  bus.subscribe<naolcm::image_t>(
      "NAO_HEAD_CAMERA_IMAGE", Bus::Queue::kAll,
      [&](const naolcm::image_t& image) { utimes.push_back(image.utime); });
  bus.subscribe<naolcm::daemon_status_t>(
      kDaemonStatusChannel, Bus::Queue::kAll,
      [&](const naolcm::daemon_status_t& status) { state = status.state; });
  const auto model = RobotModel::load(data_path() / "robots" / "nao");
  naolcm::world_truth_t truth = make_truth(model, "StandInit", 0.32);

  RunningCamera camera(url);
  const double deadline = monotonic_seconds() + 60;
  while (utimes.size() < 20 && monotonic_seconds() < deadline) {
    truth.utime += 10000;
    bus.publish(kWorldTruthChannel, truth);
    const double next = monotonic_seconds() + 0.01;
    while (monotonic_seconds() < next) bus.handle_for(0.002);
  }
  ASSERT_GE(utimes.size(), 20u);
  EXPECT_EQ(state, "ready");
  for (size_t i = 1; i < utimes.size(); ++i) EXPECT_GT(utimes[i], utimes[i - 1]);
  EXPECT_LE(utimes.back(), truth.utime);
  EXPECT_EQ(camera.stop(), 0);
}

}  // namespace
}  // namespace nao
