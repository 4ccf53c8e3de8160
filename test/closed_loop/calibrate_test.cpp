#include "closed_loop/calibrate.h"

#include <gtest/gtest.h>

#include <memory>

#include "common/data_path.h"
#include "sim/disturbance_draw.h"

namespace nao {
namespace {

TEST(Calibrate, FindsTheErrorsOfAUsedRobot) {
  ClosedLoopOptions options;
  options.model = std::make_shared<RobotModel>(RobotModel::load(data_path() / "robots" / "nao"));
  options.scene = SceneFile::find("empty");
  options.disturbances = std::make_shared<sim::DisturbanceSet>(sim::DisturbanceSet::find("real"));
  constexpr uint64_t kSeed = 101;  // One of its foot sensors is dead.
  sim::WorldOptions world;
  sim::draw_world(*options.disturbances, kSeed, world);
  sim::RobotOptions robot;
  sim::draw_robot(*options.disturbances, kSeed, 0, *options.model, world, robot);
  const sim::RobotErrors& truth = robot.errors;

  const Calibration found = calibrate(options, kSeed, 1);
  // The sensor's own bias, 0.002 rad/s, is part of the offset.
  EXPECT_LT((found.gyroscope_offset - truth.gyroscope_offset).norm(), 0.01);
  for (long i = 0; i < truth.foot_sensor_scale.size(); ++i) {
    EXPECT_EQ(found.foot_sensor_scale[i] == 0, truth.foot_sensor_scale[i] == 0) << i;
  }
}

}  // namespace
}  // namespace nao
