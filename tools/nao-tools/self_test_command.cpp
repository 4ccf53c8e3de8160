// nao self-test: moves each joint a little and looks at every sensor.

#include <cmath>
#include <cstdio>
#include <memory>
#include <naolcm/body_state_t.hpp>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <optional>
#include <string>

#include "common/command_line.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "messages/named_joints.h"
#include "tools/nao-tools/motion_session.h"
#include "tools/nao-tools/self_test.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/tools_subcommands.h"

namespace nao {
namespace {

/** Greatest time between two sensor states that counts as measured, s: a pause is longer. */
constexpr double kLongestInterval = 0.1;
/** Silence of the sensors after which there is no robot, s. */
constexpr double kSilence = 3;
/** Width and rate of the images that it asks for: enough to see whether a camera works. */
constexpr int kImageWidth = 320;
constexpr double kImageRate = 5;

/** A self-test on the bus: sends its commands, and gives it results, sensors and images. */
class SelfTester {
 public:
  SelfTester(const CommonOptions& common, const RobotModel& model)
      : model_(model), test_(model), session_(common, "nao-self-test") {
    const RobotChannels& channels = session_.channels();
    session_.bus().subscribe<naolcm::sensor_state_t>(
        channels.sensor_state, Bus::Queue::kAll, [this](const auto& message) { measure(message); });
    session_.bus().subscribe<naolcm::body_state_t>(
        channels.body_state, Bus::Queue::kAll, [this](const auto& message) { measure(message); });
    session_.bus().subscribe<naolcm::image_t>(channels.head_camera_image, Bus::Queue::kAll,
                                              [this](const auto& image) {
                                                // Other receivers' images of other sizes say
                                                // nothing more.
                                                if (image.width != kImageWidth) return;
                                                test_.add_image(image.camera, image.size_bytes);
                                              });
  }

  /** @return Why it could not be done; empty: it is done. */
  std::string execute() {
    last_sensors_ = monotonic_seconds();
    request_images();
    session_.loop().every(1.0, [this] { request_images(); });
    return session_.execute({[this] { return next_request(); },
                             [this](const std::string& fault) { test_.end_command(fault); },
                             [this] { return test_.is_done(); }});
  }

  const SelfTest& test() const { return test_; }

 private:
  std::optional<decltype(Command::request)> next_request() {
    const auto command = test_.next_command();
    if (!command) return std::nullopt;
    std::fprintf(stderr, "\r%3.0f %%", 100 * test_.progress());
    return *command;
  }

  /** Also looks whether there is a robot. */
  void request_images() {
    if (monotonic_seconds() - last_sensors_ > kSilence) return session_.fail("no robot answers");
    for (const CameraModel& camera : model_.cameras()) {
      naolcm::camera_command_t message{};
      message.camera = camera.name;
      message.width = kImageWidth;
      message.rate = kImageRate;
      session_.commands().publish(session_.channels().head_camera_command, message,
                                  session_.source());
    }
  }

  void measure(const naolcm::sensor_state_t& message) {
    last_sensors_ = monotonic_seconds();
    const double interval = static_cast<double>(message.utime - last_utime_) * 1e-6;
    last_utime_ = message.utime;
    if (interval <= 0 || interval > kLongestInterval) return;
    SelfTestSample sample;
    if (read_named_joints(model_.motor_names(), message.joint_names,
                          {{.quantity = "position",
                            .values = message.joint_position,
                            .result = sample.position,
                            .allows_nan = true},
                           {.quantity = "target",
                            .values = message.joint_target_position,
                            .result = sample.target_position,
                            .allows_nan = true}})) {
      return;
    }
    sample.accelerometer = Eigen::Vector3d(message.accelerometer_torso);
    sample.gyroscope = Eigen::Vector3d(message.gyroscope_torso);
    const double* q = message.orientation_torso_in_world;
    sample.orientation_torso_in_world = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    for (const int link : model_.foot_sensors()) {
      double force = std::nan("");
      for (size_t i = 0; i < message.foot_sensor_names.size(); ++i) {
        if (message.foot_sensor_names[i] == model_.links()[static_cast<size_t>(link)].name) {
          force = message.foot_force[i];
        }
      }
      sample.foot_force.push_back(force);
    }
    test_.measure(sample, interval);
  }

  void measure(const naolcm::body_state_t& message) {
    const std::vector<std::string> names = model_.motor_names();
    SelfTestMotors motors;
    if (message.joint_status.size() != names.size() ||
        read_named_joints(names, message.joint_names,
                          {{.quantity = "current",
                            .values = message.joint_current,
                            .result = motors.current,
                            .allows_nan = true},
                           {.quantity = "temperature",
                            .values = message.joint_temperature,
                            .result = motors.temperature,
                            .allows_nan = true}})) {
      return;  // a simulated body has lights only
    }
    // read_named_joints() reads numbers of type double; the order of the names may differ.
    motors.status.assign(names.size(), 0);
    for (size_t i = 0; i < names.size(); ++i) {
      const int motor = model_.find_motor(message.joint_names[i]);
      motors.status[static_cast<size_t>(motor)] = message.joint_status[i];
    }
    test_.measure(motors);
  }

  const RobotModel& model_;
  SelfTest test_;
  MotionSession session_;
  int64_t last_utime_ = 0;
  double last_sensors_ = 0;
};

int run_self_test(const CommonOptions& common, const std::string& model_name) {
  const RobotModel model = RobotModel::find(model_name);
  SelfTester tester(common, model);
  const std::string fault = tester.execute();
  std::fprintf(stderr, "\r     \r");
  if (!fault.empty()) {
    std::fprintf(stderr, "nao: self-test: %s\n", fault.c_str());
    return 1;
  }
  const std::vector<SelfTestFinding> findings = tester.test().findings();
  std::fputs(to_table(findings).c_str(), stdout);
  for (const SelfTestFinding& finding : findings) {
    if (finding.verdict == SelfTestFinding::Verdict::kFault) return 1;
  }
  return 0;
}

}  // namespace

void add_self_test_command(CommandLine& app, Invocation& invocation) {
  const auto model = std::make_shared<std::string>("nao");
  CommandLine* command = app.add_subcommand(kSelfTestSubcommand.name, kSelfTestSubcommand.help);
  add_model_option(*command, *model);
  invocation.on(*command, [model](const auto& common) { return run_self_test(common, *model); });
}

}  // namespace nao
