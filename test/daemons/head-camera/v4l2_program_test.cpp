// The whole program with cameras that a preloaded library fakes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <turbojpeg.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/image_t.hpp>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/wall_clock.h"
#include "test/daemons/head-camera/running_camera.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

constexpr size_t kNumFrames = 4;

/** Recorded images: halves of two colors, different in each image. */
struct Frame {
  uint8_t upper_y, lower_y, cb, cr;
};
constexpr Frame kFrames[kNumFrames] = {
    {60, 200, 128, 128}, {90, 150, 90, 170}, {120, 100, 170, 90}, {200, 50, 120, 140}};

void write_frames(const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  for (const Frame& frame : kFrames) {
    for (int v = 0; v < 480; ++v) {
      const auto y = static_cast<char>(v < 240 ? frame.upper_y : frame.lower_y);
      for (int pair = 0; pair < 320; ++pair) {
        file.put(y).put(static_cast<char>(frame.cb)).put(y).put(static_cast<char>(frame.cr));
      }
    }
  }
}

/** The program on a V6's files with /fake/... as devices, and what it publishes. */
class V4l2ProgramTest : public testing::Test {
 protected:
  V4l2ProgramTest() : bus_(private_url()) {
    write_frames(folder_.path() / "frames");
    bus_.subscribe<naolcm::image_t>(
        "NAO_HEAD_CAMERA_IMAGE", Bus::Queue::kAll,
        [this](const naolcm::image_t& image) { images_.push_back(image); });
    bus_.subscribe<naolcm::daemon_status_t>(kDaemonStatusChannel, Bus::Queue::kAll,
                                            [this](const naolcm::daemon_status_t& status) {
                                              if (status.program == "nao-head-camera")
                                                status_ = status;
                                            });
  }

  /** @param options  Beyond the usual ones. @param faults  Environment of the fake. */
  void start(const std::vector<std::string>& options,
             std::vector<std::pair<std::string, std::string>> faults = {}) {
    std::vector<std::string> all{"--source", "v4l2",      "--always",   "--rate",
                                 "30",       "--lcm-url", private_url()};
    all.insert(all.end(), options.begin(), options.end());
    faults.emplace_back("LD_PRELOAD", FAKE_V4L2_LIBRARY);
    // The sanitizer's library need not come first: this one only forwards calls.
    faults.emplace_back("ASAN_OPTIONS", "verify_asan_link_order=0:detect_leaks=0");
    faults.emplace_back("FAKE_V4L2_LOG", folder_.path() / "log");
    faults.emplace_back("FAKE_V4L2_FRAMES", folder_.path() / "frames");
    camera_.emplace(all, faults);
  }

  bool run_until(const std::function<bool()>& condition) {
    const double deadline = monotonic_seconds() + 60;
    while (!condition() && monotonic_seconds() < deadline) bus_.handle_for(0.02);
    return condition();
  }

  /** Lines of the fake's log that begin with this prefix, without the prefix. */
  std::vector<std::string> log(const std::string& prefix) const {
    std::ifstream file(folder_.path() / "log");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
      if (line.rfind(prefix, 0) == 0) lines.push_back(line.substr(prefix.size()));
    }
    return lines;
  }

  /** Frame that the camera delivered at a time, microseconds; -1: none. */
  int frame_at(const std::string& camera, int64_t utime) const {
    for (const std::string& line : log(camera + " image ")) {
      std::istringstream words(line);
      int64_t stamp = 0;
      int frame = 0;
      words >> stamp >> frame;
      if (stamp == utime) return frame;
    }
    return -1;
  }

  TemporaryFolder folder_;
  Bus bus_;
  std::optional<RunningCamera> camera_;
  std::vector<naolcm::image_t> images_;
  naolcm::daemon_status_t status_;
};

TEST_F(V4l2ProgramTest, SetsTheCameraUpInOrder) {
  start({"--model", "nao_v6", "--device", "top=/fake/video-top"});
  ASSERT_TRUE(run_until([&] { return images_.size() >= 3; }));
  EXPECT_EQ(camera_->stop(), 0);
  std::vector<std::string> calls = log("top ");
  std::erase_if(calls, [](const std::string& call) { return call.rfind("image", 0) == 0; });
  const auto control = [](uint32_t id, int value) {
    return "S_CTRL " + std::to_string(id) + " " + std::to_string(value);
  };
  EXPECT_THAT(calls, testing::ElementsAre(
                         "open", "QUERYCAP", "S_FMT 640x480 YUYV", "S_PARM 1/30", "REQBUFS",
                         // The top camera is upside down.
                         "UVC 3 12 1 0", "UVC 3 13 1 0", control(V4L2_CID_EXPOSURE_AUTO, 0),
                         control(V4L2_CID_BRIGHTNESS, 0), control(V4L2_CID_CONTRAST, 32),
                         control(V4L2_CID_SATURATION, 64), control(V4L2_CID_SHARPNESS, 4),
                         control(V4L2_CID_GAIN, 16), control(V4L2_CID_AUTO_WHITE_BALANCE, 1),
                         control(V4L2_CID_HUE_AUTO, 1), control(V4L2_CID_FOCUS_AUTO, 0),
                         control(V4L2_CID_FOCUS_ABSOLUTE, 0), "QBUF", "QBUF", "QBUF", "STREAMON",
                         "STREAMOFF", "close"));
}

TEST_F(V4l2ProgramTest, SendsRecordedImagesWithTheDriversTimes) {
  start({"--model", "nao_v6", "--device", "top=/fake/video-top"}, {{"FAKE_V4L2_DAMAGE", "1"}});
  ASSERT_TRUE(run_until([&] { return images_.size() >= 20; }));
  EXPECT_EQ(status_.state, "ready");
  camera_->stop();
  EXPECT_FALSE(log("top damaged").empty());
  tjhandle decoder = tjInitDecompress();
  std::vector<uint8_t> gray(640 * 480);
  int64_t last = 0;
  for (const naolcm::image_t& image : images_) {
    EXPECT_GT(image.utime, last);
    last = image.utime;
    ASSERT_EQ(image.width, 640);
    // 56.3 degrees of a V6: 320 / tan(28.15 degrees).
    EXPECT_NEAR(image.fx, 598.0, 1.0);
    const int frame = frame_at("top", image.utime);
    ASSERT_GE(frame, 0) << "a time that no camera gave";
    ASSERT_EQ(tjDecompress2(decoder, image.data.data(), image.data.size(), gray.data(), 640, 0, 480,
                            TJPF_GRAY, 0),
              0);
    const Frame& expected = kFrames[static_cast<size_t>(frame)];
    EXPECT_NEAR(gray[640 * 100 + 320], expected.upper_y, 3);
    EXPECT_NEAR(gray[640 * 380 + 320], expected.lower_y, 3);
  }
  tjDestroy(decoder);
}

TEST_F(V4l2ProgramTest, ResetsAllCamerasWhenOneHangs) {
  // The robot's files with the fake's bus.
  const auto robots = folder_.path() / "share" / "robots";
  std::filesystem::create_directories(robots);
  std::filesystem::copy(std::filesystem::canonical("/proc/self/exe").parent_path().parent_path() /
                            "share/nao-remote/robots/nao_v6",
                        robots / "nao_v6", std::filesystem::copy_options::recursive);
  const auto file = robots / "nao_v6/head_cameras.yaml";
  std::string content = read_text(file);
  for (const auto& [name, fake] :
       std::map<std::string, std::string>{{"/dev/video-", "/fake/video-"},
                                          {"/dev/i2c-head", "/fake/i2c"},
                                          {"wait: 2.5", "wait: 0.2"}}) {
    for (size_t at = content.find(name); at != std::string::npos; at = content.find(name, at + 1)) {
      content.replace(at, name.size(), fake);
    }
  }
  std::filesystem::remove(file);
  write_text(file, content);

  start({"--model", "nao_v6", "--camera", "bottom"},
        {{"FAKE_V4L2_HANG_AFTER", "10"}, {"NAO_REMOTE_DATA", folder_.path() / "share"}});
  ASSERT_TRUE(run_until([&] { return log("i2c write").size() == 3; }));
  const size_t num_before = images_.size();
  ASSERT_TRUE(run_until([&] { return images_.size() > num_before + 20; }));
  EXPECT_EQ(camera_->stop(), 0);
  EXPECT_THAT(log("i2c "),
              testing::ElementsAre("address 65", "write 1 0", "write 3 243", "write 1 12"));
  // Both were closed before and opened after it.
  EXPECT_EQ(log("top open").size(), 2u);
  EXPECT_EQ(log("bottom open").size(), 2u);
}

TEST_F(V4l2ProgramTest, OpensACameraAgainThatWasLost) {
  start({"--device", "/fake/video-top"}, {{"FAKE_V4L2_FAIL_AFTER", "5"}});
  ASSERT_TRUE(run_until([&] { return images_.size() >= 15; }));
  EXPECT_EQ(log("top open").size(), 2u);
}

TEST_F(V4l2ProgramTest, WaitsForACameraThatIsNotThere) {
  start({"--device", "top=/fake/video-missing"});
  ASSERT_TRUE(run_until([&] { return status_.detail.find("cannot open") != std::string::npos; }));
  EXPECT_EQ(status_.state, "waiting");
  EXPECT_THAT(status_.detail, testing::HasSubstr("camera top: cannot open /fake/video-missing"));
}

}  // namespace
}  // namespace nao
