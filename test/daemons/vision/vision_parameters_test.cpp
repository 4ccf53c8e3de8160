#include "daemons/vision/vision_parameters.h"

#include <gtest/gtest.h>

#include <fstream>

#include "common/error.h"
#include "daemons/vision/ball_filter.h"

namespace nao::vision {
namespace {

VisionParameters load(const std::string& robot_text) {
  const std::filesystem::path file = testing::TempDir() + "vision_parameters_test.yaml";
  std::ofstream(file) << robot_text;
  return VisionParameters::load(file);
}

TEST(VisionParameters, OfARobotReplaceSingleOnes) {
  const VisionParameters own = load("ball_filter: {forget_time: 1.5}");
  EXPECT_EQ(own.ball_filter.gate, VisionParameters::load().ball_filter.gate);
  BallFilter filter(own.ball_filter);
  filter.predict(0);
  filter.update({1, 0}, Eigen::Matrix2d::Identity() * 1e-4);
  filter.predict(1400000);
  EXPECT_TRUE(filter.estimate().is_known);
  filter.predict(1600000);
  EXPECT_FALSE(filter.estimate().is_known);
}

TEST(VisionParameters, AreRefusedWithTheirPlace) {
  try {
    (void)load("pose_filter:\n  tilt_tim: 2");
    FAIL() << "an unknown name is taken";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find(":2: pose_filter.tilt_tim is unknown"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace nao::vision
