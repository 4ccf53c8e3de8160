#include "daemons/head-camera/rendered_source.h"

#include <naolcm/world_truth_t.hpp>
#include <utility>

#include "common/bus.h"
#include "common/channels.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/wall_clock.h"
#include "daemons/head-camera/image_requests.h"
#include "daemons/head-camera/overview.h"
#include "rendering/decode_state.h"

namespace nao::camera {
namespace {

/** Truth that is older than this by the wall clock is not rendered: the simulator has ended, s.
 * Chosen: as long as a request is valid. */
constexpr double kTruthValidity = 2.0;
/** Truth that is older than the last one by less than this, microseconds, was overtaken by a newer
 * message and is dropped; a larger difference means that the simulation was restarted. */
constexpr int64_t kRestartThreshold = 1000000;
/** Period of looking at the state while no image is needed, s. Chosen: a quarter of kTruthValidity.
 */
constexpr double kSleepPeriod = 0.5;
/** Simulated time between two images, microseconds, above which states are read as they come: those
 * of a simulation much faster than real time would fill the socket. Chosen: three times real time.
 */
constexpr int64_t kMostBetweenImages = 100000;

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

RenderedSource::RenderedSource(Bus& bus, const RobotModel& model, const HeadCameraOptions& options)
    : bus_(bus),
      needs_every_state_(options.exposure > 0),
      model_(model),
      models_(model),
      robot_(options.robot),
      camera_(model, options) {
  // The first image of a camera compiles shaders and allocates memory; this is done before the
  // first request.
  for (const CameraModel& camera : model.cameras()) {
    camera_.take(default_world(model, options.robot), camera.name, kFullWidth / 4);
  }
  bus.subscribe<naolcm::world_truth_t>(
      kWorldTruthChannel, Bus::Queue::kLatest,
      [this](const naolcm::world_truth_t& truth) { receive_truth(truth); });
}

void RenderedSource::attach(EventLoop& loop, std::function<void(const std::string&)> on_image) {
  loop_ = &loop;
  timer_ = loop.every(1 / kMaxRate, [this, on_image = std::move(on_image)] {
    if (is_needed_) {
      read_states();
    } else {
      bus_.set_awake(kWorldTruthChannel, true);
    }
    for (const CameraModel& camera : cameras()) on_image(camera.name);
  });
}

void RenderedSource::read_states() {
  const int64_t before = world_ ? world_->utime : 0;
  bus_.handle();
  const bool may_wait =
      world_ && !needs_every_state_ && world_->utime - before <= kMostBetweenImages;
  loop_->set_watched(bus_.descriptor(), !may_wait);
}

void RenderedSource::set_needed(bool is_needed) {
  // The first state is received at once.
  is_needed |= !world_;
  if (is_needed == is_needed_ || loop_ == nullptr) return;
  is_needed_ = is_needed;
  bus_.set_awake(kWorldTruthChannel, is_needed);
  loop_->set_watched(bus_.descriptor(), true);
  loop_->set_period(timer_, is_needed ? 1 / kMaxRate : kSleepPeriod);
  needed_since_ = monotonic_seconds();
}

std::vector<CameraModel> RenderedSource::cameras() const {
  std::vector<CameraModel> cameras = model_.cameras();
  cameras.push_back(overview_camera());
  return cameras;
}

void RenderedSource::receive_truth(const naolcm::world_truth_t& truth) {
  // UDP may deliver messages out of order. The exception makes the bus count the message as
  // dropped.
  if (world_ && truth.utime < world_->utime && world_->utime - truth.utime < kRestartThreshold) {
    throw MessageError("the message is older than the previous one");
  }
  WorldState world = decode_truth(models_, truth);
  if (world_ && world.utime < world_->utime) {
    logger::info("the simulation was restarted");
    world_.reset();
  }
  earlier_ = std::exchange(world_, std::move(world));
  if (last_truth_ < needed_since_) earlier_.reset();
  last_truth_ = monotonic_seconds();
  if (!is_needed_) bus_.set_awake(kWorldTruthChannel, false);
}

std::string RenderedSource::missing_input(double now) const {
  if (!world_ || now - last_truth_ > kTruthValidity) {
    return std::string("waiting for ") + kWorldTruthChannel;
  }
  if (world_->find_robot(robot_) == nullptr) return "the world has no robot " + robot_;
  return "";
}

bool RenderedSource::has_image(const std::string& camera, double now) const {
  if (last_truth_ < needed_since_) return false;
  const bool has_truth = world_ && now - last_truth_ <= kTruthValidity;
  return camera == kOverviewCamera ? has_truth : missing_input(now).empty();
}

int64_t RenderedSource::utime(const std::string& /*camera*/) const {
  return world_ ? world_->utime : 0;
}

const CameraFrame& RenderedSource::take(const std::string& camera, int min_width) {
  if (!world_) throw Error("there is no state of the world to render");
  return camera_.take(*world_, camera, min_width, earlier_ ? &*earlier_ : nullptr);
}

std::vector<std::string> RenderedSource::take_problems() {
  return camera_.take_problems();
}

std::string RenderedSource::description() const {
  return "rendering with " + camera_.driver();
}

}  // namespace nao::camera
