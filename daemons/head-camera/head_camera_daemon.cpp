#include "daemons/head-camera/head_camera_daemon.h"

#include <algorithm>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/image_t.hpp>

#include "common/bus.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/unused_memory.h"
#include "common/wall_clock.h"
#include "daemons/head-camera/image_message.h"
#include "daemons/head-camera/rendered_source.h"
#include "daemons/head-camera/v4l2_source.h"
#include "robot_model/robot_model.h"

namespace nao::camera {
namespace {

const char* const kProgram = "nao-head-camera";
/** Interval of status messages, s: phones learn within 2 s that this program has ended, even
 * without images and if one message is lost. */
constexpr double kStatusPeriod = 0.5;
/** An unchanged state is rendered and published again after this time, s, for receivers that have
 * started since. */
constexpr double kRepeatPeriod = 0.5;
/** After this many images every shader has been compiled. Chosen: two seconds of a phone's. */
constexpr int kNumFirstFrames = 30;

std::unique_ptr<ImageSource> make_source(Bus& bus, const RobotModel& model,
                                         const HeadCameraOptions& options) {
  if (options.source == "v4l2") {
    return std::make_unique<V4l2Source>(model, V4l2Settings::load(model, options.devices),
                                        options.distortion);
  }
  return std::make_unique<RenderedSource>(bus, model, options);
}

std::vector<std::string> camera_names(const RobotModel& model) {
  std::vector<std::string> names;
  for (const CameraModel& camera : model.cameras()) names.push_back(camera.name);
  return names;
}

}  // namespace

HeadCameraDaemon::HeadCameraDaemon(Bus& bus, const RobotModel& model,
                                   const HeadCameraOptions& options)
    : bus_(bus),
      model_(model),
      options_(options),
      channels_(options.robot),
      status_(bus, kProgram, options.robot),
      source_(make_source(bus, model, options)),
      cameras_(source_->cameras()) {
  logger::info("{}", source_->description());
  if (options.webots_port) {
    webots_.emplace(camera_names(model), *options.webots_port);
    for (size_t i = 0; i < model.cameras().size(); ++i) {
      logger::info("images of camera {} by the Webots controller's protocol: 127.0.0.1:{}",
                   model.cameras()[i].name, webots_->port(i));
    }
  }
  report_problems();
  bus_.subscribe<naolcm::camera_command_t>(
      channels_.head_camera_command, Bus::Queue::kAll,
      [this](const naolcm::camera_command_t& command) { receive_command(command); });
  update_state(0, false);
  release_unused_memory();
}

void HeadCameraDaemon::attach(EventLoop& loop) {
  loop.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  source_->attach(loop, [this](const std::string& camera) { step(camera, monotonic_seconds()); });
  loop.every_aligned(kStatusPeriod, [this] {
    // A source that hangs calls no step.
    update_state(monotonic_seconds(), !valid_requests(monotonic_seconds()).empty());
    report_problems();
    publish_status();
  });
}

void HeadCameraDaemon::receive_command(const naolcm::camera_command_t& command) {
  const ImageRequest request{command.camera, command.width, command.rate, command.quality};
  const std::string problem = check_request(request, cameras_);
  if (!problem.empty()) throw MessageError(command.source + ": " + problem);
  requests_.add(command.source, request, monotonic_seconds());
  source_->set_needed(true);
}

std::vector<ImageRequest> HeadCameraDaemon::valid_requests(double now) {
  // --always is a request of the program itself, renewed in every step.
  if (options_.always) {
    requests_.add(kProgram, {options_.camera_name(model_), options_.width, options_.rate, 0}, now);
  }
  return requests_.merged(now);
}

void HeadCameraDaemon::remove_unchanged(std::vector<ImageRequest>& due, double now) {
  std::erase_if(due, [this, now](const ImageRequest& request) {
    const auto last = sent_.find({request.camera, request.width});
    return last != sent_.end() && last->second.utime == source_->utime(request.camera) &&
           now - last->second.time < kRepeatPeriod;
  });
}

void HeadCameraDaemon::step(double now) {
  for (const CameraModel& camera : cameras_) step(camera.name, now);
}

void HeadCameraDaemon::step(const std::string& camera, double now) {
  status_.tick(now);
  std::vector<ImageRequest> requests = valid_requests(now);
  update_state(now, !requests.empty());
  std::erase_if(requests, [&](const ImageRequest& request) { return request.camera != camera; });
  std::vector<ImageRequest> due = schedules_[camera].due(requests);
  if (!source_->has_image(camera, now)) return;
  remove_unchanged(due, now);
  // A failed image must not end the program; requests and states continue.
  try {
    send_images(camera, due, now);
  } catch (const Error& error) {
    if (const auto num_suppressed = warnings_.allow(now)) {
      logger::warn("no image: {} ({} more such warnings)", error.what(), *num_suppressed);
    }
  }
  report_problems();
}

// One image serves all requested sizes.
void HeadCameraDaemon::send_images(const std::string& camera, const std::vector<ImageRequest>& due,
                                   double now) {
  const bool is_for_webots = webots_ && webots_->has_clients(camera);
  if (due.empty() && !is_for_webots) return;
  int min_width = kFullWidth;
  for (const ImageRequest& request : due) min_width = std::min(min_width, request.width);
  const double start = monotonic_seconds();
  const CameraFrame& frame = source_->take(camera, min_width);
  figures_.drawing_time += monotonic_seconds() - start;
  for (const ImageRequest& request : due) {
    Sent& sent = sent_[{request.camera, request.width}];
    naolcm::image_t& image = sent.image;
    if (sent.num_changes != frame.num_changes || sent.quality != request.quality) {
      image = encode_image(frame, request, options_.quality, encoder_);
    }
    image.utime = frame.utime;
    bus_.publish(channels_.head_camera_image, image);
    sent.num_changes = frame.num_changes;
    sent.quality = request.quality;
    sent.utime = source_->utime(camera);
    sent.time = now;
    figures_.largest_message_bytes =
        std::max(figures_.largest_message_bytes, static_cast<double>(image.getEncodedSize()));
  }
  if (is_for_webots) webots_->send(frame, now);
  ++figures_.num_frames;
  if (++num_frames_ == kNumFirstFrames) release_unused_memory();
}

void HeadCameraDaemon::report_problems() {
  for (const std::string& problem : source_->take_problems()) logger::warn("{}", problem);
}

void HeadCameraDaemon::update_state(double now, bool has_requests) {
  source_->set_needed(has_requests || webots_);
  const std::string missing = source_->missing_input(now);
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
