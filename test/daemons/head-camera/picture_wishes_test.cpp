#include "daemons/head-camera/picture_wishes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nao {
namespace {

TEST(PictureWishes, EndTwoSecondsAfterTheLastRepetition) {
  PictureWishes wishes;
  wishes.add("phone", {"top", 640, 30, 0}, 10.0);
  EXPECT_EQ(wishes.merged(11.9).size(), 1u);
  wishes.add("phone", {"top", 640, 30, 0}, 11.9);
  EXPECT_EQ(wishes.merged(13.8).size(), 1u);
  EXPECT_TRUE(wishes.merged(14.0).empty());
}

TEST(PictureWishes, GiveEachSizeTheHighestRateAndQualityAskedFor) {
  PictureWishes wishes;
  wishes.add("a", {"top", 320, 10, 90}, 0);
  wishes.add("b", {"top", 320, 25, 50}, 0);
  wishes.add("c", {"bottom", 320, 5, 0}, 0);
  wishes.add("d", {"top", 160, 5, 0}, 0);
  const auto merged = wishes.merged(1);
  ASSERT_EQ(merged.size(), 3u);
  for (const PictureWish& wish : merged) {
    if (wish.camera != "top" || wish.width != 320) continue;
    EXPECT_EQ(wish.rate, 25);
    EXPECT_EQ(wish.quality, 90);
  }
}

TEST(PictureWishes, AreBoundedInNumber) {
  PictureWishes wishes;
  for (int i = 0; i < 10000; ++i) wishes.add(std::to_string(i), {"top", 640, 1, 0}, 0);
  wishes.add("one more", {"bottom", 640, 1, 0}, 0);
  EXPECT_EQ(wishes.merged(1).size(), 1u);
}

TEST(PictureWishes, RefuseWhatCannotBeMade) {
  EXPECT_EQ(refuse_wish({"top", 640, 30, 0}), "");
  EXPECT_EQ(refuse_wish({"bottom", 160, 1, 95}), "");
  EXPECT_NE(refuse_wish({"rear", 640, 30, 0}), "");
  EXPECT_NE(refuse_wish({"top", 641, 30, 0}), "");
  EXPECT_NE(refuse_wish({"top", 0, 30, 0}), "");
  EXPECT_NE(refuse_wish({"top", -160, 30, 0}), "");
  EXPECT_NE(refuse_wish({"top", 640, 0, 0}), "");
  EXPECT_NE(refuse_wish({"top", 640, 31, 0}), "");
  EXPECT_NE(refuse_wish({"top", 640, std::numeric_limits<double>::quiet_NaN(), 0}), "");
  EXPECT_NE(refuse_wish({"top", 640, 30, 96}), "");
  EXPECT_NE(refuse_wish({"top", 640, 30, -1}), "");
}

TEST(PictureSchedule, MeetsEveryRateToOnePicture) {
  for (const double rate : {1.0, 7.0, 10.0, 15.0, 20.0, 24.0, 29.0, 30.0}) {
    PictureSchedule schedule;
    int num_due = 0;
    for (int turn = 0; turn < 300; ++turn) {
      num_due += static_cast<int>(schedule.due({{"top", 640, rate, 0}}).size());
    }
    EXPECT_NEAR(num_due, 10 * rate, 1) << rate;
  }
}

TEST(PictureSchedule, ServesANewcomerAtOnce) {
  PictureSchedule schedule;
  schedule.due({{"top", 640, 1, 0}});
  const auto due = schedule.due({{"top", 640, 1, 0}, {"bottom", 640, 1, 0}});
  ASSERT_EQ(due.size(), 1u);
  EXPECT_EQ(due[0].camera, "bottom");
}

}  // namespace
}  // namespace nao
