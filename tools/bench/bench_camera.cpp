// Measures the processor time of one image of the head camera, stage by stage, and of a baseline
// that every renderer needs: clear, read back, resize, compress. Both run alternately, so that
// other load on the machine affects both.

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <functional>
#include <map>
#include <naolcm/image_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "common/bus.h"
#include "common/channels.h"
#include "common/event_loop.h"
#include "common/processor_time.h"
#include "common/wall_clock.h"
#include "daemons/head-camera/half_size.h"
#include "daemons/head-camera/head_camera.h"
#include "daemons/head-camera/head_camera_daemon.h"
#include "daemons/head-camera/image_requests.h"
#include "daemons/head-camera/jpeg_encoder.h"
#include "rendering/decode_state.h"
#include "rendering/gl.h"
#include "robot_model/robot_model.h"
#include "tools/bench/run_benchmark.h"

namespace {

using nao::Figure;
using nao::camera::CameraFrame;
using nao::camera::HeadCamera;
using nao::camera::HeadCameraDaemon;
using nao::camera::HeadCameraOptions;
using nao::camera::JpegEncoder;

/** Camera of the NAO that is measured. */
const char* const kCamera = "top";
constexpr int kQuality = 80;
constexpr int kMostBytes = 64000;

/** Times of named stages, one entry a round, ms of processor time. */
class Stages {
 public:
  void measure(const std::string& name, const std::function<void()>& work) {
    const double start = nao::process_seconds();
    work();
    add(name, 1e3 * (nao::process_seconds() - start));
  }
  void add(const std::string& name, double time_ms) { times_ms_[name].push_back(time_ms); }
  double median_ms(const std::string& name) const { return nao::median(times_ms_.at(name)); }

 private:
  std::map<std::string, std::vector<double>> times_ms_;
};

/** Own robot in the centre of the field; another one, facing it, and the ball in its view. */
naolcm::world_truth_t soccer_truth(const nao::RobotModel& model) {
  naolcm::robot_truth_t robot{};
  robot.robot = "NAO";
  robot.position_torso_in_world[2] = model.references().heights.standing;
  robot.orientation_torso_in_world[0] = 1;
  robot.num_joints = model.num_motors();
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    robot.joint_names.push_back(model.motor_joint(motor).name);
  }
  robot.joint_position = model.ready_posture().position;
  robot.joint_velocity.assign(model.num_motors(), 0);
  robot.joint_torque.assign(model.num_motors(), 0);
  naolcm::world_truth_t truth{};
  truth.scene = "soccer";
  truth.robots.push_back(robot);
  robot.robot = "OTHER";
  robot.position_torso_in_world[0] = 1.2;
  robot.position_torso_in_world[1] = 0.1;
  robot.orientation_torso_in_world[0] = 0;
  robot.orientation_torso_in_world[3] = 1;
  truth.robots.push_back(robot);
  truth.num_robots = 2;
  truth.has_ball = 1;
  truth.position_ball_in_world[0] = 0.9;
  truth.position_ball_in_world[1] = -0.2;
  truth.position_ball_in_world[2] = 0.05;
  truth.orientation_ball_in_world[0] = 1;
  return truth;
}

nao::WorldState soccer_world(const nao::RobotModel& model) {
  nao::RobotModels models(model);
  return nao::decode_truth(models, soccer_truth(model));
}

void encode_all(const CameraFrame& frame, JpegEncoder& encoder) {
  for (const int width : {640, 320, 160}) {
    encoder.encode(frame.bgrx[CameraFrame::level(width)], width, width * 3 / 4, kQuality,
                   kMostBytes);
  }
}

/** All stages of one image in three sizes. */
void take_and_encode(HeadCamera& camera, const nao::WorldState& world, JpegEncoder& encoder) {
  encode_all(camera.take(world, kCamera, 160), encoder);
}

void measure_stages(HeadCamera& camera, const nao::WorldState& world, JpegEncoder& encoder,
                    Stages& stages) {
  stages.measure("draw", [&] {
    camera.draw(world, kCamera);
    glFinish();
  });
  stages.measure("read_back", [&] { camera.read_back(); });
  stages.measure("smaller", [&] { camera.make_smaller(160); });
  for (const int width : {640, 320, 160}) {
    stages.measure("jpeg_" + std::to_string(width), [&] {
      encoder.encode(camera.frame().bgrx[CameraFrame::level(width)], width, width * 3 / 4, kQuality,
                     kMostBytes);
    });
  }
}

/** So far the other robot moves between two states, m: an image of what does not move is not
 * computed again. */
constexpr double kMove = 1e-4;

/** Percentage of one core that the daemon uses at full rate, with 100 states a second as from the
 * simulator. @param move  m, of the other robot between two states. */
double daemon_percent(const nao::RobotModel& model, double seconds, double move) {
  nao::Bus bus("memq://");
  HeadCameraOptions options;
  options.always = true;
  HeadCameraDaemon daemon(bus, model, options);
  naolcm::world_truth_t truth = soccer_truth(model);
  const auto turns = [&](int num_turns) {
    for (int turn = 0; turn < num_turns; ++turn) {
      for (int i = 0; i < 10; ++i) {  // ten states for three images
        truth.utime += 10000;
        truth.robots[1].position_torso_in_world[1] += move;
        bus.publish(nao::kWorldTruthChannel, truth);
        while (bus.handle_for(0)) {
        }
        if (i % 3 == 0 && i < 9) daemon.step(nao::monotonic_seconds());
      }
    }
  };
  turns(3);
  const double start = nao::process_seconds();
  turns(static_cast<int>(10 * seconds));
  return 100 * (nao::process_seconds() - start) / seconds;
}

/** Ages of the images when they are published, s: time since their state was published. States (100
 * a second) and images have independent timers, as in two programs. */
std::vector<double> frame_ages(const nao::RobotModel& model, double seconds) {
  nao::EventLoop loop;
  nao::Bus bus("memq://");
  HeadCameraOptions options;
  options.always = true;
  HeadCameraDaemon daemon(bus, model, options);
  naolcm::world_truth_t truth = soccer_truth(model);
  std::map<int64_t, double> published;
  std::vector<double> ages;
  bus.subscribe<naolcm::image_t>(
      nao::RobotChannels(options.robot).head_camera_image, nao::Bus::Queue::kAll,
      [&](const naolcm::image_t& image) {
        ages.push_back(nao::monotonic_seconds() - published.at(image.utime));
      });
  daemon.attach(loop);
  loop.every(0.01, [&] {
    truth.utime += 10000;
    truth.robots[1].position_torso_in_world[1] += kMove;
    published[truth.utime] = nao::monotonic_seconds();
    bus.publish(nao::kWorldTruthChannel, truth);
  });
  loop.every(seconds, [&] { loop.stop("measured"); });
  loop.run();
  return ages;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::vector<Figure> run(int num_rounds) {
  const auto model = nao::RobotModel::find("nao");
  nao::WorldState world = soccer_world(model);
  std::vector<Figure> figures;
  JpegEncoder encoder;
  Stages stages;
  {
    // Only one context is current at a time, so the measurements with and without shadows alternate
    // in blocks.
    constexpr int kBlocks = 5;
    for (int block = 0; block < kBlocks; ++block) {
      for (const int shadow_size : {HeadCameraOptions().shadow_size, 0}) {
        HeadCameraOptions options;
        options.shadow_size = shadow_size;
        HeadCamera camera(model, options);
        if (block == 0 && shadow_size > 0) fmt::print("drawing with {}\n", camera.driver());
        for (int i = 0; i < 3; ++i) take_and_encode(camera, world, encoder);
        // The baseline compresses the same images, so that this work is the same.
        const CameraFrame frame = camera.frame();
        const nao::gl::Framebuffer floor_target(nao::camera::kFullWidth, nao::camera::kFullHeight);
        std::vector<uint8_t> cleared;
        std::vector<uint8_t> half;
        std::vector<uint8_t> quarter;
        const std::string scene = shadow_size > 0 ? "soccer" : "plain";
        for (int round = 0; round < num_rounds / kBlocks; ++round) {
          stages.measure("floor", [&] {
            glBindFramebuffer(GL_FRAMEBUFFER, floor_target.id());
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            floor_target.read(cleared);
            nao::camera::halve(frame.bgrx[0], 640, 480, half);
            nao::camera::halve(half, 320, 240, quarter);
            encode_all(frame, encoder);
          });
          world.robots[1].pose_torso_in_world.translation().y() += round % 2 == 0 ? kMove : -kMove;
          const double start = nao::monotonic_seconds();
          stages.measure(scene, [&] { take_and_encode(camera, world, encoder); });
          if (shadow_size > 0) {
            const double wall_ms = 1e3 * (nao::monotonic_seconds() - start);
            stages.add("wall", wall_ms);
            measure_stages(camera, world, encoder, stages);
          }
        }
      }
    }
  }
  const double floor_ms = stages.median_ms("floor");
  const double soccer_ms = stages.median_ms("soccer");
  figures.push_back({"camera.soccer_ms", soccer_ms, "ms", "floor", floor_ms});
  figures.push_back({"camera.soccer_over_floor", soccer_ms / floor_ms, "1", "", 0});
  figures.push_back({"camera.soccer_wall_ms", stages.median_ms("wall"), "ms", "", 0});
  figures.push_back({"camera.plain_ms", stages.median_ms("plain"), "ms", "floor", floor_ms});
  for (const char* stage : {"draw", "read_back", "smaller", "jpeg_640", "jpeg_320", "jpeg_160"}) {
    figures.push_back(
        {std::string("camera.stage.") + stage + "_ms", stages.median_ms(stage), "ms", "", 0});
  }
  figures.push_back({"camera.cpu_30hz_percent", daemon_percent(model, 5, kMove), "%", "", 0});
  figures.push_back({"camera.still_30hz_percent", daemon_percent(model, 5, 0), "%", "", 0});
  std::vector<double> ages = frame_ages(model, 10);
  std::sort(ages.begin(), ages.end());
  // The newest state can be as old as a frame period, and drawing takes its time.
  const double limit_ms = 1e3 / 30 + stages.median_ms("wall");
  const size_t p99 = ages.size() * 99 / 100;
  figures.push_back({"camera.frame_age_ms", 1e3 * nao::median(ages), "ms", "limit", limit_ms});
  figures.push_back({"camera.frame_age_p99_ms", 1e3 * ages[p99], "ms", "limit", limit_ms});
  figures.push_back({"camera.rss_mb", peak_memory_mb(), "MB", "", 0});
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  nao::CommandLine app("Measures the head camera; times are processor time of one process",
                       "nao-bench-camera");
  int num_rounds = 100;
  app.add_option("--rounds", num_rounds, "Images of each kind")->range(5, 100000);
  return nao::run_benchmark(app, argc, argv, [&] { return run(num_rounds); });
}
