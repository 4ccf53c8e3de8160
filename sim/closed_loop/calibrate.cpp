#include "sim/closed_loop/calibrate.h"

#include <utility>
#include <variant>

#include "calibration/calibration_run.h"

namespace nao {
namespace {

// Time in which the robot comes to a stand before the first command, and time after which a command
// that has not ended has failed, s.
constexpr double kTakeOver = 1;
constexpr double kTimeout = 30;

// The readings are raw: the calibration must see the robot's errors.
StandingSample to_sample(const sim::SensorReadings& readings) {
  StandingSample sample;
  sample.position.assign(readings.position.begin(), readings.position.end());
  sample.accelerometer = readings.accelerometer;
  sample.gyroscope = readings.gyroscope;
  sample.foot_force.assign(readings.foot_force.begin(), readings.foot_force.end());
  return sample;
}

}  // namespace

// The same run as `nao calibrate` with a robot: commands, waiting and measuring on simulated time.
Calibration calibrate(const ClosedLoopOptions& options, uint64_t seed, int num_stations) {
  ClosedLoop loop(options, seed);
  CalibrationRun run(loop.model(), num_stations);
  loop.run(kTakeOver);
  while (!run.is_done()) {
    if (auto command = run.next_command()) {
      const auto send = [&](auto& request) { return loop.send({"", 0, std::move(request)}); };
      const int64_t id = std::visit(send, *command);
      const auto end = loop.await_end(id, kTimeout);
      const bool is_done = end && end->status == ResultStatus::kDone;
      run.end_command(is_done ? "" : end ? to_sentence(end->reason) : "did not end");
    }
    loop.step();
    run.measure(to_sample(loop.world().sensors(0)), loop.period());
  }
  return run.estimator().solve();
}

}  // namespace nao
