#include "daemons/vision/vision_daemon.h"

#include <cstdlib>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/play_state_t.hpp>
#include <utility>

#include "common/bus.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/wall_clock.h"
#include "daemons/vision/jpeg_decoder.h"
#include "daemons/vision/vision_messages.h"

namespace nao::vision {
namespace {

const char* const kProgram = "nao-vision";
/** s. */
constexpr double kStatusPeriod = 1;
constexpr double kRequestPeriod = 1;
/** Time without a play_state_t after which nao-play has ended, s. */
constexpr double kPlayTimeout = 1;
/** Time without an image after which the program reports that it waits, s. */
constexpr double kImageValidity = 2;
/** Width of requested images, pixels. */
constexpr int kWidth = 640;
/** Least width that is processed: in smaller images a ball at 2 m has two pixels. */
constexpr int kLeastWidth = 320;
/** While wide images of a camera come, narrower ones of it, for other receivers, are left out:
 * microseconds since the last wide one. */
constexpr int64_t kWideValidity = 500000;
/** Images that are older than the last one by less than this were overtaken, microseconds; by more:
 * the simulation was restarted. */
constexpr int64_t kRestartThreshold = 1000000;

}  // namespace

VisionDaemon::VisionDaemon(Bus& bus, const RobotModel& model, const VisionOptions& options)
    : bus_(bus),
      model_(model),
      options_(options),
      channels_(options.robot),
      status_(bus, kProgram, options.robot),
      commands_(bus, channels_),
      poses_(model),
      core_(VisionNetworks::load(), VisionParameters::load(model.folder() / "vision.yaml")) {
  configure_process();
  if (options_.field_start) {
    core_.localize(options_.field_start->first, options_.field_start->second);
  }
  // All states are received: an image is matched with the state of its own time.
  bus_.subscribe<naolcm::robot_state_t>(
      channels_.robot_state, Bus::Queue::kAll,
      [this](const naolcm::robot_state_t& state) { poses_.add(decode_posture(model_, state)); });
  // All images, of which process_images() takes the newest: LCM's queue of one message keeps the
  // oldest two, which on a busy host are a second old when their turn comes.
  bus_.subscribe<naolcm::image_t>(channels_.head_camera_image, Bus::Queue::kAll,
                                  [this](const naolcm::image_t& image) { receive_image(image); });
  bus_.subscribe<naolcm::play_state_t>(
      channels_.play_state, Bus::Queue::kLatest, [this](const naolcm::play_state_t& play) {
        last_play_ = monotonic_seconds();
        if (std::exchange(play_camera_, play.camera) != play.camera) request(play.camera);
      });
  publish_status(monotonic_seconds());
}

void VisionDaemon::attach(EventLoop& loop) {
  loop.on_readable(bus_.descriptor(), [this] {
    bus_.handle();
    process_images();
  });
  loop.every_aligned(kStatusPeriod, [this] { publish_status(monotonic_seconds()); });
  request(options_.request_camera);
  loop.every(kRequestPeriod, [this] { request_images(); });
}

// The request is repeated because requests expire.
void VisionDaemon::request_images() {
  request(options_.request_camera);
  const bool has_play = monotonic_seconds() - last_play_ < kPlayTimeout;
  if (has_play && play_camera_ != options_.request_camera) request(play_camera_);
}

void VisionDaemon::request(const std::string& camera) {
  if (camera.empty()) return;
  naolcm::camera_command_t command{};
  command.camera = camera;
  command.width = kWidth;
  command.rate = options_.rate;
  commands_.publish(channels_.head_camera_command, command, kProgram);
}

void VisionDaemon::receive_image(const naolcm::image_t& image) {
  // The image is too small to be processed, and meant for other receivers.
  if (image.width < kLeastWidth) return;
  const auto wide = last_wide_image_.find(image.camera);
  if (image.width >= kWidth) {
    last_wide_image_[image.camera] = image.utime;
  } else if (wide != last_wide_image_.end() &&
             std::abs(image.utime - wide->second) < kWideValidity) {
    return;
  }
  const auto last = last_image_.find(image.camera);
  if (last != last_image_.end() && image.utime <= last->second &&
      last->second - image.utime < kRestartThreshold) {
    return;
  }
  last_image_[image.camera] = image.utime;
  waiting_[image.camera] = image;
}

void VisionDaemon::process_images() {
  for (const auto& [camera, image] : std::exchange(waiting_, {})) {
    try {
      process(image);
    } catch (const MessageError& error) {
      ++num_refused_;
      if (const auto num_suppressed = warnings_.allow(monotonic_seconds())) {
        logger::warn("{}: image refused: {} ({} similar warnings suppressed)",
                     channels_.head_camera_image, error.what(), *num_suppressed);
      }
    }
  }
}

void VisionDaemon::process(const naolcm::image_t& image) {
  const double start = monotonic_seconds();
  if (image.format != "jpeg") throw MessageError("the image's format is not jpeg");
  VisionInput input;
  input.calibration = decode_calibration(image);
  const std::string problem = decode_jpeg(image.data.data(), image.data.size(), bgr_);
  if (!problem.empty()) throw MessageError(problem);
  if (bgr_.cols != image.width || bgr_.rows != image.height) {
    throw MessageError("the size of the image differs from its message's");
  }
  input.bgr = bgr_;
  input.utime = image.utime;
  input.camera = image.camera;
  // Without a pose (no motion daemon) objects are found in the image, without positions.
  if (const auto pose = poses_.find(image.camera, image.utime)) {
    input.pose_camera_in_heading = pose->pose_camera_in_heading;
    input.heading_in_odometry = pose->heading_in_odometry;
    input.is_upright = pose->is_upright;
  }
  bus_.publish(channels_.vision_state,
               encode_result(core_.process(input), image.utime, image.camera));
  last_image_time_ = monotonic_seconds();
  processing_time_ += last_image_time_ - start;
  ++num_new_images_;
  ++num_images_;
}

void VisionDaemon::publish_status(double now) {
  status_.tick(now);
  const bool has_images = now - last_image_time_ < kImageValidity;
  // The program may be unused: without images it is ready, not faulty.
  status_.set_state("ready", has_images ? "" : "no images");
  const double period = now - last_status_;
  status_.publish(
      {{"images_hz", last_status_ > 0 ? num_new_images_ / period : 0},
       {"processing_ms", num_new_images_ > 0 ? 1e3 * processing_time_ / num_new_images_ : 0}});
  last_status_ = now;
  num_new_images_ = 0;
  processing_time_ = 0;
}

}  // namespace nao::vision
