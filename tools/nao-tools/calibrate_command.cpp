// nao calibrate: learns how this robot's joints and sensors differ from its model.

#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <naolcm/sensor_state_t.hpp>
#include <optional>
#include <string>

#include "calibration/calibration_run.h"
#include "common/bus.h"
#include "common/command_line.h"
#include "common/output_file.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "messages/named_joints.h"
#include "tools/nao-tools/motion_session.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/tools_subcommands.h"

namespace nao {
namespace {

struct CalibrateOptions {
  std::string model = "nao";
  std::string file = "calibration.yaml";
  int num_stations = 4;
};

// Greatest time between two sensor states that counts as measured, s: a pause of the simulator is
// longer.
constexpr double kMaxInterval = 0.1;

std::string now_as_text() {
  const std::time_t now = wall_utime() / 1000000;
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
  return text;
}

/** A calibration on the bus: sends the run's commands, and gives it results and sensors. */
class Calibrator {
 public:
  Calibrator(const CommonOptions& common, const RobotModel& model, int num_stations)
      : model_(model), run_(model, num_stations), session_(common, "nao-calibrate") {
    session_.bus().subscribe<naolcm::sensor_state_t>(
        session_.channels().sensor_state, Bus::Queue::kAll,
        [this](const auto& message) { measure(message); });
  }

  /** @return Why not all poses were measured: Ctrl-C, silence or repeated faults; empty: they were.
   */
  std::string execute() {
    const std::string fault =
        session_.execute({[this] { return next_request(); },
                          [this](const std::string& reason) { run_.end_command(reason); },
                          [this] { return run_.is_done(); }});
    return fault.empty() ? run_.fault() : fault;
  }

  CalibrationEstimator& estimator() { return run_.estimator(); }

 private:
  std::optional<decltype(Command::request)> next_request() {
    const auto command = run_.next_command();
    if (!command) return std::nullopt;
    std::printf("\r%3.0f %%", 100 * run_.progress());
    std::fflush(stdout);
    return std::visit([](const auto& request) { return decltype(Command::request)(request); },
                      *command);
  }

  void measure(const naolcm::sensor_state_t& message) {
    const double interval = static_cast<double>(message.utime - last_utime_) * 1e-6;
    last_utime_ = message.utime;
    if (interval <= 0 || interval > kMaxInterval) return;
    StandingSample sample;
    if (read_named_joints(model_.motor_names(), message.joint_names,
                          {{"position", message.joint_position, sample.position}})) {
      return;
    }
    sample.accelerometer = Eigen::Vector3d(message.accelerometer_torso);
    sample.gyroscope = Eigen::Vector3d(message.gyroscope_torso);
    for (const int link : model_.foot_sensors()) {
      for (int i = 0; i < message.num_foot_sensors; ++i) {
        if (message.foot_sensor_names[i] == model_.links()[link].name) {
          sample.foot_force.push_back(message.foot_force[i]);
        }
      }
    }
    const bool is_complete = sample.foot_force.size() == model_.foot_sensors().size();
    bool is_finite = sample.accelerometer.allFinite() && sample.gyroscope.allFinite();
    for (const double force : sample.foot_force) is_finite = is_finite && std::isfinite(force);
    if (is_complete && is_finite) run_.measure(sample, interval);
  }

  const RobotModel& model_;
  CalibrationRun run_;
  MotionSession session_;
  int64_t last_utime_ = 0;
};

int calibrate(const CommonOptions& common, const CalibrateOptions& options) {
  const RobotModel model = RobotModel::find(options.model);
  Calibrator calibrator(common, model, options.num_stations);
  const std::string fault = calibrator.execute();
  std::printf("\n");
  if (!fault.empty()) {
    std::fprintf(stderr, "nao: calibrate: %s; wrote nothing\n", fault.c_str());
    return 1;
  }
  CalibrationEstimator& estimator = calibrator.estimator();
  Calibration calibration = estimator.solve();
  calibration.date = now_as_text();
  replace_file(options.file, calibration.to_yaml(model));
  for (const int sensor : estimator.dead_sensors()) {
    std::printf("foot sensor %s reads nothing: it is dead\n",
                model.links()[model.foot_sensors()[sensor]].name.c_str());
  }
  std::printf("%d stands; the weight acts %.1f mm beside the center of mass, %.1f mm corrected\n",
              estimator.num_samples(), 1e3 * estimator.pressure_error_before(),
              1e3 * estimator.pressure_error_after());
  std::printf("wrote %s; start nao-motion with --calibration %s\n", options.file.c_str(),
              options.file.c_str());
  return 0;
}

}  // namespace

void add_calibrate_command(CommandLine& app, Invocation& invocation) {
  const auto options = std::make_shared<CalibrateOptions>();
  CommandLine* command = app.add_subcommand(kCalibrateSubcommand.name, kCalibrateSubcommand.help);
  command->add_option("--output", options->file, "File to write");
  add_model_option(*command, options->model);
  command
      ->add_option("--directions", options->num_stations,
                   "Directions in which it stands; with 1 it does not walk, and takes a slope of "
                   "the floor for an error of its own")
      ->range(1, 8);
  invocation.on(*command, [options](const auto& common) { return calibrate(common, *options); });
}

}  // namespace nao
