#include "daemons/head-camera/head_camera_daemon.h"

#include <algorithm>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <set>
#include <utility>

#include "common/bus.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/wall_clock.h"
#include "daemons/head-camera/image_message.h"
#include "rendering/decode_state.h"

namespace nao::camera {
namespace {

const char* const kProgram = "nao-head-camera";
/** Truth that is older than this by the wall clock is not rendered: the simulator has ended, s.
 * Chosen: as long as a request is valid. */
constexpr double kTruthValidity = 2.0;
/** Interval of status messages, s: phones learn within 2 s that this program has ended, even
 * without images and if one message is lost. */
constexpr double kStatusPeriod = 0.5;
/** An unchanged state is rendered and published again after this time, s, for receivers that have
 * started since. */
constexpr double kRepeatPeriod = 0.5;
/** Truth whose time is earlier by less than this was overtaken by a newer message and is dropped; a
 * larger difference means that the simulation was restarted. Microseconds. */
constexpr int64_t kRestartThreshold = 1000000;

/** A robot with all joints at 0, for rendering before any message has arrived. */
WorldState default_world(const RobotModel& model, const std::string& robot) {
  WorldState world;
  world.scene = "empty";
  RobotPose pose;
  pose.name = robot;
  pose.position.assign(model.num_motors(), 0.0);
  // About the height of the NAO's torso with straight legs, m.
  pose.pose_torso_in_world.translation().z() = 0.33;
  world.robots.push_back(pose);
  world.pose_ball_in_world = Eigen::Translation3d(0.5, 0, 0.05) * Eigen::Isometry3d::Identity();
  return world;
}

}  // namespace

HeadCameraDaemon::HeadCameraDaemon(Bus& bus, const RobotModel& model,
                                   const HeadCameraOptions& options)
    : bus_(bus),
      model_(model),
      options_(options),
      channels_(options.robot),
      status_(bus, kProgram),
      camera_(model, options) {
  logger::info("rendering with {}", camera_.driver());
  for (const CameraModel& camera : model.cameras()) {
    camera_.take(default_world(model, options.robot), camera.name, kFullWidth / 4);
  }
  report_problems();
  bus_.subscribe<naolcm::world_truth_t>(
      kWorldTruthChannel, Bus::Queue::kLatest,
      [this](const naolcm::world_truth_t& truth) { receive_truth(truth); });
  bus_.subscribe<naolcm::camera_command_t>(
      channels_.head_camera_command, Bus::Queue::kAll,
      [this](const naolcm::camera_command_t& command) { receive_command(command); });
  update_state(0, false);
}

void HeadCameraDaemon::attach(EventLoop& loop) {
  loop.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  loop.every(1 / kMaxRate, [this] { step(monotonic_seconds()); });
  loop.every(kStatusPeriod, [this] { publish_status(); });
}

void HeadCameraDaemon::receive_truth(const naolcm::world_truth_t& truth) {
  if (world_ && truth.utime < world_->utime && world_->utime - truth.utime < kRestartThreshold) {
    throw Error("the message is older than the previous one");
  }
  WorldState world = decode_truth(model_, truth);
  if (world_ && world.utime < world_->utime) {
    logger::info("the simulation was restarted");
    sent_.clear();
    world_.reset();
  }
  earlier_ = std::exchange(world_, std::move(world));
  last_truth_ = monotonic_seconds();
}

void HeadCameraDaemon::receive_command(const naolcm::camera_command_t& command) {
  const ImageRequest request{command.camera, command.width, command.rate, command.quality};
  const std::string problem = check_request(request, model_.cameras());
  if (!problem.empty()) throw Error(command.source + ": " + problem);
  requests_.add(command.source, request, monotonic_seconds());
}

std::vector<ImageRequest> HeadCameraDaemon::valid_requests(double now) {
  if (options_.always) {
    requests_.add(kProgram, {options_.camera_name(model_), options_.width, options_.rate, 0}, now);
  }
  return requests_.merged(now);
}

void HeadCameraDaemon::remove_unchanged(std::vector<ImageRequest>& due, double now) {
  std::erase_if(due, [this, now](const ImageRequest& request) {
    const auto last = sent_.find({request.camera, request.width});
    return last != sent_.end() && last->second.utime == world_->utime &&
           now - last->second.time < kRepeatPeriod;
  });
}

void HeadCameraDaemon::step(double now) {
  status_.tick(now);
  const std::vector<ImageRequest> requests = valid_requests(now);
  update_state(now, !requests.empty());
  std::vector<ImageRequest> due = schedule_.due(requests);
  if (!missing_input(now).empty()) return;
  remove_unchanged(due, now);
  std::set<std::string> cameras;
  for (const ImageRequest& request : due) cameras.insert(request.camera);
  try {
    for (const std::string& camera : cameras) send_images(camera, due, now);
  } catch (const std::exception& error) {
    if (const auto num_suppressed = warnings_.allow(now)) {
      logger::warn("no image: {} ({} more such warnings)", error.what(), *num_suppressed);
    }
  }
  report_problems();
}

void HeadCameraDaemon::send_images(const std::string& camera, const std::vector<ImageRequest>& due,
                                   double now) {
  int min_width = kFullWidth;
  for (const ImageRequest& request : due) {
    if (request.camera == camera) min_width = std::min(min_width, request.width);
  }
  const double start = monotonic_seconds();
  const CameraFrame& frame =
      camera_.take(*world_, camera, min_width, earlier_ ? &*earlier_ : nullptr);
  figures_.drawing_time += monotonic_seconds() - start;
  for (const ImageRequest& request : due) {
    if (request.camera != camera) continue;
    const naolcm::image_t image = encode_image(frame, request, options_.quality, encoder_);
    bus_.publish(channels_.head_camera_image, image);
    sent_[{request.camera, request.width}] = {world_->utime, now};
    figures_.largest_message_bytes =
        std::max(figures_.largest_message_bytes, static_cast<double>(image.getEncodedSize()));
  }
  ++num_frames_;
  ++figures_.num_frames;
}

void HeadCameraDaemon::report_problems() {
  for (const std::string& problem : camera_.take_problems()) logger::warn("{}", problem);
}

std::string HeadCameraDaemon::missing_input(double now) const {
  if (!world_ || now - last_truth_ > kTruthValidity) {
    return std::string("waiting for ") + kWorldTruthChannel;
  }
  if (world_->find_robot(options_.robot) == nullptr) {
    return "the world has no robot " + options_.robot;
  }
  return "";
}

void HeadCameraDaemon::update_state(double now, bool has_requests) {
  const std::string missing = missing_input(now);
  const std::string state = missing.empty() ? "ready" : "waiting";
  const std::string detail = !missing.empty() ? missing : has_requests ? "" : "no image requested";
  if (state + detail == last_state_) return;
  last_state_ = state + detail;
  status_.set_state(state, detail);
  logger::info("{}{}", state, detail.empty() ? "" : ": " + detail);
  publish_status();  // at once, since other programs wait for the change
}

void HeadCameraDaemon::publish_status() {
  const double now = monotonic_seconds();
  const double period = now - last_status_;
  const double drawing_ms =
      figures_.num_frames > 0 ? 1e3 * figures_.drawing_time / figures_.num_frames : 0;
  status_.publish({{"frames_hz", last_status_ > 0 ? figures_.num_frames / period : 0},
                   {"drawing_ms", drawing_ms},
                   {"largest_message_bytes", figures_.largest_message_bytes}});
  last_status_ = now;
  figures_ = {};
}

}  // namespace nao::camera
