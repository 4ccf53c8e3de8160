// Measures the motion core: CPU time of one step while standing and while walking, and the
// real-time factor of simulator and motion core on one CPU core.

#include <memory>
#include <vector>

#include "common/processor_time.h"
#include "robot_model/robot_model.h"
#include "sim/closed_loop/closed_loop.h"
#include "tools/bench/run_benchmark.h"

namespace nao {
namespace {

ClosedLoopOptions trial_options() {
  ClosedLoopOptions options;
  options.model = std::make_shared<RobotModel>(RobotModel::find("nao"));
  options.scene = SceneFile::find("empty");
  return options;
}

/** Median CPU time of a motion core's step, us; the sensor states come from a trial. */
double step_us(const Eigen::Vector3d& velocity, double seconds) {
  ClosedLoop trial(trial_options(), 1);
  std::vector<double> times;
  trial.measure_steps(thread_seconds, times);
  trial.run(1);
  if (!velocity.isZero()) {
    trial.hold_walk(velocity);
    trial.run(2);
  }
  times.clear();
  trial.run(seconds);
  return 1e6 * median(times);
}

double real_time_factor(double seconds) {
  ClosedLoop trial(trial_options(), 1);
  trial.run(1);
  const double begin = thread_seconds();
  trial.run(seconds);
  return seconds / (thread_seconds() - begin);
}

std::vector<Figure> measure(double seconds) {
  return {{"motion.step_us", step_us(Eigen::Vector3d::Zero(), seconds), "us", "", 0},
          {"motion.walking_step_us", step_us({0.1, 0, 0}, seconds), "us", "", 0},
          {"trial.real_time_factor", real_time_factor(seconds), "x", "", 0}};
}

}  // namespace
}  // namespace nao

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Measures the motion core's step, and simulator and core together on one core.",
      "nao-bench-motion");
  double seconds = 20;
  app.add_option("--seconds", seconds, "Simulated time of each measurement, s");
  return nao::run_benchmark(app, argc, argv, [&] { return nao::measure(seconds); });
}
