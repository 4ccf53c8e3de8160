#include "daemons/head-camera/v4l2_source.h"

#include <cmath>
#include <utility>

#include "common/error.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/wall_clock.h"
#include "daemons/head-camera/camera_reset.h"
#include "daemons/head-camera/half_size.h"
#include "daemons/head-camera/image_requests.h"
#include "daemons/head-camera/yuyv.h"

namespace nao::camera {
namespace {

/** Time without an image after which a camera counts as hung, s: the value of B-Human and HULKs. */
constexpr double kHangTime = 1.0;
/** The same for the first image after the start of the stream, s. Chosen: exposure control and
 * firmware take some time. */
constexpr double kFirstImageTime = 3.0;
/** Time between two attempts to open a camera, s. Chosen. */
constexpr double kRetryTime = 1.0;
/** Period of the checks, s. Chosen: a tenth of the shortest time that they measure. */
constexpr double kCheckPeriod = 0.1;

}  // namespace

V4l2Source::V4l2Source(const RobotModel& model, const V4l2Settings& settings,
                       const Distortion& distortion)
    : model_(model), settings_(settings), cameras_(settings.cameras.size()) {
  for (size_t i = 0; i < cameras_.size(); ++i) {
    Camera& camera = cameras_[i];
    camera.settings = settings.cameras[i];
    camera.frame.camera = camera.settings.camera;
    camera.frame.distortion = distortion;
    for (const CameraModel& description : model.cameras()) {
      if (description.name == camera.frame.camera) camera.frame.pinhole = pinhole_of(description);
    }
  }
}

void V4l2Source::attach(EventLoop& loop, std::function<void(const std::string&)> on_image) {
  loop_ = &loop;
  on_image_ = std::move(on_image);
  loop.every(kCheckPeriod, [this] { check(monotonic_seconds()); });
  check(monotonic_seconds());
}

void V4l2Source::check(double now) {
  for (Camera& camera : cameras_) {
    if (!camera.device) {
      if (now >= camera.open_time) open(camera, now);
      continue;
    }
    const bool is_first = !camera.device->has_image();
    if (now - camera.last_time > (is_first ? kFirstImageTime : kHangTime)) {
      recover(camera, "has stopped delivering images", now);
    }
  }
}

void V4l2Source::open(Camera& camera, double now) {
  try {
    camera.device = std::make_unique<V4l2Device>(camera.settings);
  } catch (const Error& error) {
    camera.fault = error.what();
    camera.open_time = now + kRetryTime;
    warn(camera, error.what(), now);
    return;
  }
  camera.last_time = monotonic_seconds();
  camera.frame.exposure_time = camera.device->exposure_time();
  for (const std::string& problem : camera.device->problems()) problems_.push_back(problem);
  logger::info("camera {}: {} is open", camera.frame.camera, camera.settings.device);
  loop_->on_readable(camera.device->descriptor(), [this, &camera] { receive(camera); });
}

void V4l2Source::receive(Camera& camera) {
  try {
    if (!camera.device->receive()) return;
  } catch (const Error& error) {
    recover(camera, error.what(), monotonic_seconds());
    return;
  }
  camera.last_time = monotonic_seconds();
  camera.fault.clear();
  // Mid exposure: the driver stamps its start.
  camera.frame.utime =
      std::llround(1e6 * (camera.device->image_time() + 0.5 * camera.frame.exposure_time));
  on_image_(camera.frame.camera);
}

void V4l2Source::close(Camera& camera) {
  if (!camera.device) return;
  loop_->forget(camera.device->descriptor());
  camera.device.reset();
}

void V4l2Source::recover(Camera& camera, const std::string& fault, double now) {
  warn(camera, fault, now);
  camera.fault = fault;
  close(camera);
  camera.open_time = now + kRetryTime;
  if (!settings_.reset) return;
  // Both cameras hang on one reset line: the other one is closed before it disappears.
  for (Camera& other : cameras_) {
    close(other);
    other.open_time = now + settings_.reset->wait;
    if (&other != &camera) other.fault = "is being reset";
  }
  try {
    reset_cameras(*settings_.reset);
  } catch (const Error& error) {
    warn(camera, std::string("no reset: ") + error.what(), now);
  }
}

void V4l2Source::warn(Camera& camera, const std::string& text, double now) {
  if (const auto num_suppressed = camera.warnings.allow(now)) {
    logger::warn("camera {} {} ({} more such warnings)", camera.frame.camera, text,
                 *num_suppressed);
  }
}

size_t V4l2Source::find(const std::string& name) const {
  size_t i = 0;
  while (i < cameras_.size() && cameras_[i].frame.camera != name) ++i;
  return i;
}

std::string V4l2Source::missing_input(double now) const {
  std::string faults;
  for (const Camera& camera : cameras_) {
    if (has_image(camera.frame.camera, now)) return "";
    faults += (faults.empty() ? "camera " : "; camera ") + camera.frame.camera + ": " +
              (camera.fault.empty() ? "no image yet" : camera.fault);
  }
  return faults;
}

bool V4l2Source::has_image(const std::string& name, double now) const {
  const size_t i = find(name);
  if (i == cameras_.size()) return false;
  const Camera& camera = cameras_[i];
  return camera.device && camera.device->has_image() && now - camera.last_time <= kHangTime;
}

int64_t V4l2Source::utime(const std::string& name) const {
  const size_t i = find(name);
  return i < cameras_.size() ? cameras_[i].frame.utime : 0;
}

const CameraFrame& V4l2Source::take(const std::string& name, int min_width) {
  const size_t i = find(name);
  if (i == cameras_.size() || !cameras_[i].device || !cameras_[i].device->has_image()) {
    throw Error("camera " + name + " has no image");
  }
  CameraFrame& frame = cameras_[i].frame;
  ++frame.num_changes;
  yuyv_to_bgrx(cameras_[i].device->image(), kFullWidth, kFullHeight, frame.bgrx[0]);
  for (int level = 1; level <= CameraFrame::level(min_width); ++level) {
    const auto index = static_cast<size_t>(level);
    halve(frame.bgrx[index - 1], kFullWidth >> (level - 1), kFullHeight >> (level - 1),
          frame.bgrx[index]);
  }
  return frame;
}

std::vector<std::string> V4l2Source::take_problems() {
  return std::exchange(problems_, {});
}

std::string V4l2Source::description() const {
  std::string text = "reading";
  for (const Camera& camera : cameras_) {
    text += " " + camera.frame.camera + " from " + camera.settings.device;
  }
  return text;
}

}  // namespace nao::camera
