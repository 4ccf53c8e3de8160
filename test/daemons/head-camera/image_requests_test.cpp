#include "daemons/head-camera/image_requests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "robot_model/robot_model.h"

namespace nao::camera {
namespace {

TEST(ImageRequests, EndTwoSecondsAfterTheLastRepetition) {
  ImageRequests requests;
  requests.add("phone", {"top", 640, 30, 0}, 10.0);
  EXPECT_EQ(requests.merged(11.9).size(), 1u);
  requests.add("phone", {"top", 640, 30, 0}, 11.9);
  EXPECT_EQ(requests.merged(13.8).size(), 1u);
  EXPECT_TRUE(requests.merged(14.0).empty());
}

TEST(ImageRequests, GiveEachSizeTheHighestRequestedRateAndQuality) {
  ImageRequests requests;
  requests.add("a", {"top", 320, 10, 90}, 0);
  requests.add("b", {"top", 320, 25, 50}, 0);
  requests.add("c", {"bottom", 320, 5, 0}, 0);
  requests.add("d", {"top", 160, 5, 0}, 0);
  const auto merged = requests.merged(1);
  ASSERT_EQ(merged.size(), 3u);
  for (const ImageRequest& request : merged) {
    if (request.camera != "top" || request.width != 320) continue;
    EXPECT_EQ(request.rate, 25);
    EXPECT_EQ(request.quality, 90);
  }
}

TEST(ImageRequests, AreBoundedInNumber) {
  ImageRequests requests;
  for (int i = 0; i < 10000; ++i) requests.add(std::to_string(i), {"top", 640, 1, 0}, 0);
  requests.add("one more", {"bottom", 640, 1, 0}, 0);
  EXPECT_EQ(requests.merged(1).size(), 1u);
}

TEST(ImageRequests, AreCheckedAgainstCamerasWidthsRatesAndQualities) {
  const std::vector<CameraModel> cameras{{.name = "head"}, {.name = "chest"}};
  const auto is_valid = [&](const ImageRequest& request) {
    return check_request(request, cameras).empty();
  };
  EXPECT_TRUE(is_valid({"head", 640, 30, 0}));
  EXPECT_TRUE(is_valid({"chest", 160, 1, 95}));
  EXPECT_FALSE(is_valid({"top", 640, 30, 0}));
  EXPECT_FALSE(is_valid({"", 640, 30, 0}));
  EXPECT_FALSE(is_valid({"head", 641, 30, 0}));
  EXPECT_FALSE(is_valid({"head", 0, 30, 0}));
  EXPECT_FALSE(is_valid({"head", -160, 30, 0}));
  EXPECT_FALSE(is_valid({"head", 640, 0, 0}));
  EXPECT_FALSE(is_valid({"head", 640, 31, 0}));
  EXPECT_FALSE(is_valid({"head", 640, std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(is_valid({"head", 640, 30, 96}));
  EXPECT_FALSE(is_valid({"head", 640, 30, -1}));
  EXPECT_EQ(check_request({"top", 640, 30, 0}, cameras),
            "the robot has no camera \"top\"; its cameras are: head, chest");
}

TEST(ImageSchedule, MeetsEveryRateToOneImage) {
  for (const double rate : {1.0, 7.0, 10.0, 15.0, 20.0, 24.0, 29.0, 30.0}) {
    ImageSchedule schedule;
    int num_due = 0;
    for (int step = 0; step < 300; ++step) {
      num_due += static_cast<int>(schedule.due({{"top", 640, rate, 0}}).size());
    }
    EXPECT_NEAR(num_due, 10 * rate, 1) << rate;
  }
}

TEST(ImageSchedule, ServesANewRequestAtOnce) {
  ImageSchedule schedule;
  schedule.due({{"top", 640, 1, 0}});
  const auto due = schedule.due({{"top", 640, 1, 0}, {"bottom", 640, 1, 0}});
  ASSERT_EQ(due.size(), 1u);
  EXPECT_EQ(due[0].camera, "bottom");
}

}  // namespace
}  // namespace nao::camera
