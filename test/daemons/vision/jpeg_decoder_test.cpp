#include "daemons/vision/jpeg_decoder.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "common/random.h"

namespace nao::vision {
namespace {

std::vector<uint8_t> encoded(int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  cv::randu(image, 0, 255);
  std::vector<uint8_t> file;
  cv::imencode(".jpg", image, file);
  return file;
}

TEST(JpegDecoder, DecodesAnImage) {
  cv::Mat image;
  const auto file = encoded(320, 240);
  EXPECT_EQ(decode_jpeg(file.data(), file.size(), image), "");
  EXPECT_EQ(image.cols, 320);
  EXPECT_EQ(image.rows, 240);
}

TEST(JpegDecoder, RefusesEveryTruncation) {
  cv::Mat image;
  const auto file = encoded(160, 120);
  // The last two bytes are only the end marker.
  for (size_t length = 0; length + 2 < file.size(); length += 37) {
    EXPECT_NE(decode_jpeg(file.data(), length, image), "") << length;
  }
}

TEST(JpegDecoder, RefusesHugeAndTinyImages) {
  cv::Mat image;
  for (const auto& file : {encoded(2000, 100), encoded(32, 32)}) {
    EXPECT_NE(decode_jpeg(file.data(), file.size(), image), "");
  }
}

TEST(JpegDecoder, SurvivesChangedBytes) {
  cv::Mat image;
  const auto file = encoded(160, 120);
  Random random(5);
  for (int round = 0; round < 500; ++round) {
    auto changed = file;
    for (int i = 0; i < 3; ++i) {
      changed[random.next() % changed.size()] = static_cast<uint8_t>(random.next());
    }
    const std::string problem = decode_jpeg(changed.data(), changed.size(), image);
    if (problem.empty()) {
      EXPECT_LE(image.cols, 1280);
    }
  }
}

// The state after a damaged file must not make the decoder refuse the next ones.
TEST(JpegDecoder, DecodesAnImageAfterEachDamagedOne) {
  cv::Mat image;
  const auto file = encoded(64, 48);
  Random random(7);
  for (int round = 0; round < 2000; ++round) {
    auto changed = file;
    // The first bytes are the headers and tables.
    changed[random.next() % 700] = static_cast<uint8_t>(random.next());
    static_cast<void>(decode_jpeg(changed.data(), changed.size(), image));
    ASSERT_EQ(decode_jpeg(file.data(), file.size(), image), "") << round;
  }
}

}  // namespace
}  // namespace nao::vision
