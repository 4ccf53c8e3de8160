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

/** Period at which a state is decoded, although no image is due, to know whether the world has the
 * robot, s: of the status. */
constexpr double kRobotCheckPeriod = 0.5;

/** Robot time of an encoded message, which begins with the fingerprint of its type, microseconds.
 */
std::optional<int64_t> utime_of(std::span<const uint8_t> bytes) {
  if (bytes.size() < 16) return std::nullopt;
  uint64_t utime = 0;
  for (const uint8_t byte : bytes.subspan(8, 8)) utime = utime << 8 | byte;
  return static_cast<int64_t>(utime);
}

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
    : model_(model),
      models_(model),
      robot_(options.robot),
      needs_earlier_(options.exposure > 0),
      camera_(model, options) {
  // The first image of a camera compiles shaders and allocates memory; this is done before the
  // first request.
  for (const CameraModel& camera : model.cameras()) {
    camera_.take(default_world(model, options.robot), camera.name, kFullWidth / 4);
  }
  bus.subscribe_encoded(kWorldTruthChannel, Bus::Queue::kLatest,
                        [this](const RawMessage& message) { receive_truth(message); });
}

void RenderedSource::attach(EventLoop& loop, std::function<void(const std::string&)> on_image) {
  loop.every(1 / kMaxRate, [this, on_image = std::move(on_image)] {
    for (const CameraModel& camera : cameras()) on_image(camera.name);
  });
}

std::vector<CameraModel> RenderedSource::cameras() const {
  std::vector<CameraModel> cameras = model_.cameras();
  cameras.push_back(overview_camera());
  return cameras;
}

void RenderedSource::receive_truth(const RawMessage& message) {
  const std::optional<int64_t> utime = utime_of(message.bytes);
  if (!utime) throw MessageError("it is too short");
  // UDP may deliver messages out of order. The exception makes the bus count the message as
  // dropped.
  if (*utime < utime_ && utime_ - *utime < kRestartThreshold) {
    throw MessageError("the message is older than the previous one");
  }
  earlier_.clear();
  if (*utime < utime_) {
    logger::info("the simulation was restarted");
  } else if (needs_earlier_) {
    earlier_.swap(newest_);
  }
  newest_.assign(message.bytes.begin(), message.bytes.end());
  utime_ = *utime;
  is_decoded_ = false;
  last_truth_ = monotonic_seconds();
}

// Only when a state is needed: 100 come a second, of which at most 30 are drawn.
void RenderedSource::decode(double now) {
  if (std::exchange(is_decoded_, true)) return;
  last_decoded_ = now;
  const auto read = [this](const std::vector<uint8_t>& bytes) -> std::optional<WorldState> {
    if (bytes.empty()) return std::nullopt;
    naolcm::world_truth_t truth;
    if (!decode_message(bytes, truth)) throw MessageError("it is not a world_truth_t");
    return decode_truth(models_, truth);
  };
  try {
    std::optional<WorldState> world = read(newest_);
    earlier_world_ = read(earlier_);
    world_ = std::move(world);
  } catch (const MessageError& error) {
    utime_ = world_ ? world_->utime : 0;
    if (const auto num_suppressed = warnings_.allow(now)) {
      problems_.push_back(std::string(kWorldTruthChannel) + ": message dropped: " + error.what() +
                          " (" + std::to_string(*num_suppressed) + " similar warnings suppressed)");
    }
  }
}

std::string RenderedSource::missing_input(double now) {
  if (!world_ || now - last_decoded_ >= kRobotCheckPeriod) decode(now);
  if (!world_ || now - last_truth_ > kTruthValidity) {
    return std::string("waiting for ") + kWorldTruthChannel;
  }
  if (world_->find_robot(robot_) == nullptr) return "the world has no robot " + robot_;
  return "";
}

bool RenderedSource::has_image(const std::string& camera, double now) {
  decode(now);
  const bool has_truth = world_ && now - last_truth_ <= kTruthValidity;
  return camera == kOverviewCamera ? has_truth : missing_input(now).empty();
}

int64_t RenderedSource::utime(const std::string& /*camera*/) const {
  return utime_;
}

const CameraFrame& RenderedSource::take(const std::string& camera, int min_width) {
  if (!world_) throw Error("there is no state of the world to render");
  return camera_.take(*world_, camera, min_width, earlier_world_ ? &*earlier_world_ : nullptr);
}

std::vector<std::string> RenderedSource::take_problems() {
  std::vector<std::string> problems = camera_.take_problems();
  problems.insert(problems.end(), problems_.begin(), problems_.end());
  problems_.clear();
  return problems;
}

std::string RenderedSource::description() const {
  return "rendering with " + camera_.driver();
}

}  // namespace nao::camera
