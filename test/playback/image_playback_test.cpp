// nao-head-camera renders a frozen world as the frozen image.

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <naolcm/image_t.hpp>
#include <optional>

#include "common/bus.h"
#include "common/wall_clock.h"
#include "test/playback/frozen_log.h"
#include "test/support/child_program.h"

namespace nao::playback {
namespace {

/** Generous: the machine may be busy with other things. */
constexpr double kPatience = 60;
constexpr int kWidth = 160;
constexpr int kHeight = 120;
// Mean over all channels, of 255. Drivers and JPEG encoders round differently; a mirrored image
// is off by more than 20.
constexpr double kMaxMeanDifference = 5;

using Image = std::vector<uint8_t>;

Image pixels_of(const std::vector<uint8_t>& jpeg) {
  Image pixels(3 * kWidth * kHeight);
  tjhandle handle = tjInitDecompress();
  EXPECT_EQ(tjDecompress2(handle, jpeg.data(), jpeg.size(), pixels.data(), kWidth, 0, kHeight,
                          TJPF_RGB, 0),
            0)
      << tjGetErrorStr2(handle);
  tjDestroy(handle);
  return pixels;
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::abs(int{a[i]} - int{b[i]});
  return sum / static_cast<double>(a.size());
}

TEST(ImagePlayback, AFrozenWorldGivesTheFrozenImage) {
  const std::filesystem::path sessions(NAO_PLAYBACK_SESSIONS);
  const auto world = read_frozen_log(sessions / "view.truth.lcmlog");
  const ChildProgram camera("nao-head-camera", {"--lcm-url", private_bus_url(), "--always",
                                                "--width", "160", "--log-level", "warning"});
  Bus bus(private_bus_url());
  std::optional<naolcm::image_t> image;
  bus.subscribe<naolcm::image_t>("NAO_HEAD_CAMERA_IMAGE", Bus::Queue::kLatest,
                                 [&](const auto& message) {
                                   if (message.width == kWidth) image = message;
                                 });
  const double end = monotonic_seconds() + kPatience;
  while (!image && monotonic_seconds() < end) {
    send(bus, world.back());
    bus.handle_for(0.1);
  }
  ASSERT_TRUE(image);
  const auto file = sessions / "view.jpg";
  if (std::getenv("NAO_WRITE_COURSES") != nullptr) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(image->data.data()), image->size_bytes);
    GTEST_SKIP() << "wrote " << file;
  }
  std::ifstream stream(file, std::ios::binary);
  const std::vector<uint8_t> frozen{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_LT(mean_difference(pixels_of(image->data), pixels_of(frozen)), kMaxMeanDifference);
}

}  // namespace
}  // namespace nao::playback
