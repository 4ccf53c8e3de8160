#include "sim/closed_loop/calibrate.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <variant>

#include "calibration/calibration_run.h"
#include "common/data_path.h"
#include "sim/disturbance_draw.h"

namespace nao {
namespace {

// The tipping guard once refused the poses, and robots were calibrated by the first stand alone.
TEST(Calibrate, TheRobotTakesEveryPose) {
  ClosedLoopOptions options;
  options.model = std::make_shared<RobotModel>(RobotModel::load(data_path() / "robots" / "nao"));
  options.scene = SceneFile::find("empty");
  ClosedLoop loop(options, 1);
  CalibrationRun run(loop.model(), 1);
  loop.run(1);
  const double tilt = loop.torso_tilt();
  while (!run.is_done()) {
    if (auto command = run.next_command()) {
      const auto send = [&](auto& request) { return loop.send({"", 0, std::move(request)}); };
      const int64_t id = std::visit(send, *command);
      const auto end = loop.await_end(id, 30);
      ASSERT_TRUE(end);
      EXPECT_EQ(end->status, ResultStatus::kDone) << to_sentence(end->reason);
      run.end_command("");
    }
    loop.step();
    const sim::SensorReadings& readings = loop.world().sensors(0);
    StandingSample sample;
    sample.position.assign(readings.position.begin(), readings.position.end());
    sample.accelerometer = readings.accelerometer;
    sample.gyroscope = readings.gyroscope;
    sample.foot_force.assign(readings.foot_force.begin(), readings.foot_force.end());
    run.measure(sample, loop.period());
  }
  EXPECT_NEAR(loop.torso_tilt(), tilt, 0.02);
}

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
