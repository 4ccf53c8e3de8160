#include "daemons/head-camera/yuyv.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace nao::camera {
namespace {

TEST(Yuyv, ConvertsKnownColors) {
  // Values of ITU-T T.871: white, black, and pure red.
  const std::vector<uint8_t> yuyv{255, 128, 0, 128, 76, 85, 76, 255};
  std::vector<uint8_t> bgrx;
  yuyv_to_bgrx(yuyv, 2, 2, bgrx);
  // Rows from the bottom up.
  const std::vector<uint8_t> expected{0,   0,   254, 255, 0, 0, 254, 255,
                                      255, 255, 255, 255, 0, 0, 0,   255};
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(bgrx[i], expected[i], 1) << i;
}

TEST(Yuyv, KeepsAnImageThatItConvertsForthAndBack) {
  constexpr int kWidth = 32;
  constexpr int kHeight = 6;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> luma(80, 170);
  std::uniform_int_distribution<int> chroma(100, 156);
  std::vector<uint8_t> yuyv(2 * kWidth * kHeight);
  for (size_t i = 0; i < yuyv.size(); ++i) {
    yuyv[i] = static_cast<uint8_t>(i % 2 == 0 ? luma(random) : chroma(random));
  }
  std::vector<uint8_t> bgrx;
  yuyv_to_bgrx(yuyv, kWidth, kHeight, bgrx);
  std::vector<uint8_t> back(yuyv.size());
  bgrx_to_yuyv(bgrx, kWidth, kHeight, back);
  for (size_t i = 0; i < yuyv.size(); ++i) ASSERT_NEAR(back[i], yuyv[i], 1) << i;
}

}  // namespace
}  // namespace nao::camera
