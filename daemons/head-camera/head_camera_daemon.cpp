#include "daemons/head-camera/head_camera_daemon.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "common/error.h"
#include "common/wall_clock.h"
#include "rendering/decode_state.h"

namespace nao {
namespace {

const char* const kProgram = "nao-head-camera";
/** Room in a message for everything but the picture. */
constexpr int kHeaderBytes = 512;
/** Truth older than this by the wall clock means that the simulator is gone, s. */
constexpr double kTruthValidity = 2.0;
/** Phones that watch no pictures shall be told within 2 s when this program is gone, though one of
 * its messages was lost. */
constexpr double kStatusPeriod = 0.5;
/** A state that did not change is shown again after this, s: a watcher may have come. */
constexpr double kRepeat = 0.5;
/** Time running back by less than this is a message overtaken by another; by more, a new start, us.
 */
constexpr int64_t kNewStart = 1000000;

/** A robot standing with all joints at 0, to draw something before anything is known. */
WorldState blank_world(const RobotModel& model, const std::string& robot) {
  WorldState world;
  world.scene = "empty";
  RobotPose pose;
  pose.name = robot;
  pose.position.assign(model.num_motors(), 0.0);
  pose.pose_torso_in_world.translation().z() = 0.33;
  world.robots.push_back(pose);
  world.pose_ball_in_world = Eigen::Translation3d(0.5, 0, 0.05) * Eigen::Isometry3d::Identity();
  return world;
}

}  // namespace

naolcm::image_t encode_image(const CameraFrame& frame, const PictureWish& wish, int default_quality,
                             JpegEncoder& encoder) {
  const PinholeCamera pinhole = frame.pinhole.resized(wish.width);
  naolcm::image_t image;
  // The exposure ends at the state's time; the message has its middle.
  image.utime = frame.utime - std::llround(frame.exposure_time * 1e6 / 2);
  image.camera = frame.camera;
  image.width = pinhole.width;
  image.height = pinhole.height;
  image.fx = pinhole.fx;
  image.fy = pinhole.fy;
  image.cx = pinhole.cx;
  image.cy = pinhole.cy;
  std::copy(frame.distortion.begin(), frame.distortion.end(), image.distortion);
  image.exposure_time = frame.exposure_time;
  image.format = "jpeg";
  const int quality = wish.quality > 0 ? wish.quality : default_quality;
  image.data = encoder.encode(frame.bgrx[CameraFrame::level(wish.width)], image.width, image.height,
                              quality, kMostMessageBytes - kHeaderBytes);
  image.size_bytes = static_cast<int>(image.data.size());
  return image;
}

HeadCameraDaemon::HeadCameraDaemon(Bus& bus, const RobotModel& model,
                                   const HeadCameraOptions& options)
    : bus_(bus),
      model_(model),
      options_(options),
      channels_(options.robot),
      status_(bus, kProgram),
      camera_(model, options) {
  spdlog::info("drawing with {}", camera_.driver());
  for (const CameraModel& camera : model.cameras()) {
    camera_.take(blank_world(model, options.robot), camera.name, kFullWidth / 4);
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
  loop.every(1 / kFastestRate, [this] { step(monotonic_seconds()); });
  loop.every(kStatusPeriod, [this] { publish_status(); });
}

void HeadCameraDaemon::receive_truth(const naolcm::world_truth_t& truth) {
  if (world_ && truth.utime < world_->utime && world_->utime - truth.utime < kNewStart) {
    throw Error("a state came after a newer one");
  }
  WorldState world = decode_truth(model_, truth);
  if (world_ && world.utime < world_->utime) {
    spdlog::info("the world's time started anew");
    sent_.clear();
    world_.reset();
  }
  earlier_ = std::exchange(world_, std::move(world));
  last_truth_ = monotonic_seconds();
}

void HeadCameraDaemon::receive_command(const naolcm::camera_command_t& command) {
  const PictureWish wish{command.camera, command.width, command.rate, command.quality};
  const std::string refusal = refuse_wish(wish);
  if (!refusal.empty()) throw Error(command.source + ": " + refusal);
  watchers_.add(command.source, wish, monotonic_seconds());
}

std::vector<PictureWish> HeadCameraDaemon::wishes(double now) {
  if (options_.always) {
    watchers_.add(kProgram, {options_.camera, options_.width, options_.rate, 0}, now);
  }
  return watchers_.merged(now);
}

void HeadCameraDaemon::keep_new(std::vector<PictureWish>& due, double now) {
  std::erase_if(due, [this, now](const PictureWish& wish) {
    const auto last = sent_.find({wish.camera, wish.width});
    return last != sent_.end() && last->second.utime == world_->utime &&
           now - last->second.time < kRepeat;
  });
}

void HeadCameraDaemon::step(double now) {
  status_.tick(now);
  const std::vector<PictureWish> wished = wishes(now);
  update_state(now, !wished.empty());
  std::vector<PictureWish> due = schedule_.due(wished);
  if (!lacks(now).empty()) return;
  keep_new(due, now);
  std::set<std::string> cameras;
  for (const PictureWish& wish : due) cameras.insert(wish.camera);
  try {
    for (const std::string& camera : cameras) send_pictures(camera, due, now);
  } catch (const std::exception& error) {
    if (const auto kept_back = warnings_.allow(now)) {
      spdlog::warn("no picture: {} ({} more)", error.what(), *kept_back);
    }
  }
  report_problems();
}

void HeadCameraDaemon::send_pictures(const std::string& camera, const std::vector<PictureWish>& due,
                                     double now) {
  int least_width = kFullWidth;
  for (const PictureWish& wish : due) {
    if (wish.camera == camera) least_width = std::min(least_width, wish.width);
  }
  const double start = monotonic_seconds();
  const CameraFrame& frame =
      camera_.take(*world_, camera, least_width, earlier_ ? &*earlier_ : nullptr);
  new_drawing_time_ += monotonic_seconds() - start;
  for (const PictureWish& wish : due) {
    if (wish.camera != camera) continue;
    const naolcm::image_t image = encode_image(frame, wish, options_.quality, encoder_);
    bus_.publish(channels_.head_camera_image, image);
    sent_[{wish.camera, wish.width}] = {frame.utime, now};
    largest_message_bytes_ =
        std::max(largest_message_bytes_, static_cast<double>(image.getEncodedSize()));
  }
  ++num_frames_;
  ++num_new_frames_;
}

void HeadCameraDaemon::report_problems() {
  for (const std::string& problem : camera_.take_problems()) spdlog::warn("{}", problem);
}

std::string HeadCameraDaemon::lacks(double now) const {
  if (!world_ || now - last_truth_ > kTruthValidity) {
    return std::string("waiting for ") + kWorldTruthChannel;
  }
  if (world_->find_robot(options_.robot) == nullptr) {
    return "the world has no robot " + options_.robot;
  }
  return "";
}

void HeadCameraDaemon::update_state(double now, bool is_watched) {
  const std::string lacks = this->lacks(now);
  const std::string state = lacks.empty() ? "ready" : "waiting";
  const std::string detail = !lacks.empty() ? lacks : is_watched ? "" : "nobody watches";
  if (state + detail == last_state_) return;
  last_state_ = state + detail;
  status_.set_state(state, detail);
  spdlog::info("{}{}", state, detail.empty() ? "" : ": " + detail);
  publish_status();  // at once: others wait for it
}

void HeadCameraDaemon::publish_status() {
  const double now = monotonic_seconds();
  const double period = now - last_status_;
  const double drawing_ms = num_new_frames_ > 0 ? 1e3 * new_drawing_time_ / num_new_frames_ : 0;
  status_.publish({{"frames_hz", last_status_ > 0 ? num_new_frames_ / period : 0},
                   {"drawing_ms", drawing_ms},
                   {"largest_message_bytes", largest_message_bytes_}});
  last_status_ = now;
  num_new_frames_ = 0;
  new_drawing_time_ = 0;
  largest_message_bytes_ = 0;
}

}  // namespace nao
