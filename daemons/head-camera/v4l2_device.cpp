#include "daemons/head-camera/v4l2_device.h"

#include <fcntl.h>
#include <linux/usb/video.h>
#include <linux/uvcvideo.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/error.h"
#include "common/wall_clock.h"
#include "daemons/head-camera/image_requests.h"

namespace nao::camera {
namespace {

/** Buffers shared with the driver. Chosen as B-Human (3) and HULKs (4): one is shown, one is
 * filled, the others bridge delays. */
constexpr uint32_t kNumBuffers = 4;
/** Least number of buffers; with fewer no image can be kept while the next one arrives. */
constexpr uint32_t kLeastBuffers = 2;
constexpr size_t kImageBytes = static_cast<size_t>(2) * kFullWidth * kFullHeight;
/** V4L2_CID_EXPOSURE_ABSOLUTE's unit, s. */
constexpr double kExposureUnit = 1e-4;

/** Calls ioctl(2), and repeats it if a signal interrupts it. */
template <class Argument>
int control(int descriptor, unsigned long request, Argument* argument) {
  int result = 0;
  do {
    result = ioctl(descriptor, request, argument);
  } while (result < 0 && errno == EINTR);
  return result;
}

v4l2_buffer make_buffer(uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

}  // namespace

V4l2Device::V4l2Device(const V4l2CameraSettings& settings) : device_(settings.device) {
  descriptor_ = open(device_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) throw Error("cannot open " + device_ + ": " + std::strerror(errno));
  try {
    check_capabilities();
    set_format();
    set_rate();
    map_buffers();
    // The stream shows images with these settings from its first one on.
    set_controls(settings);
    for (size_t i = 0; i < buffers_.size(); ++i) queue(static_cast<int>(i));
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (control(descriptor_, VIDIOC_STREAMON, &type) < 0) fail("start the stream");
  } catch (const Error&) {
    release();
    throw;
  }
}

V4l2Device::~V4l2Device() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  control(descriptor_, VIDIOC_STREAMOFF, &type);
  release();
}

// Buffers must be unmapped before the driver frees them.
void V4l2Device::release() {
  for (const Buffer& buffer : buffers_) munmap(buffer.start, buffer.length);
  close(descriptor_);
}

void V4l2Device::fail(const std::string& step) const {
  throw Error(device_ + ": cannot " + step + ": " + std::strerror(errno));
}

void V4l2Device::check_capabilities() {
  v4l2_capability capability{};
  if (control(descriptor_, VIDIOC_QUERYCAP, &capability) < 0) {
    throw Error(device_ + " is not a video device");
  }
  const uint32_t flags = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                             ? capability.device_caps
                             : capability.capabilities;
  constexpr uint32_t kNeeded = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  if ((flags & kNeeded) != kNeeded) throw Error(device_ + " does not stream captured images");
}

void V4l2Device::set_format() {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_pix_format& pixels = format.fmt.pix;
  pixels.width = kFullWidth;
  pixels.height = kFullHeight;
  pixels.pixelformat = V4L2_PIX_FMT_YUYV;
  pixels.field = V4L2_FIELD_NONE;
  if (control(descriptor_, VIDIOC_S_FMT, &format) < 0) fail("set the format");
  // The driver answers with the nearest format that it has.
  if (pixels.width != kFullWidth || pixels.height != kFullHeight ||
      pixels.pixelformat != V4L2_PIX_FMT_YUYV || pixels.bytesperline != 2 * kFullWidth) {
    throw Error(device_ + " does not deliver YUYV images of 640x480 pixels");
  }
}

void V4l2Device::set_rate() {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  parameters.parm.capture.timeperframe = {1, static_cast<uint32_t>(kMaxRate)};
  // Not all cameras have a choice.
  if (control(descriptor_, VIDIOC_S_PARM, &parameters) < 0) {
    problems_.push_back(device_ + " does not let its rate be set");
  }
}

void V4l2Device::map_buffers() {
  v4l2_requestbuffers request{};
  request.count = kNumBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (control(descriptor_, VIDIOC_REQBUFS, &request) < 0) fail("get buffers");
  if (request.count < kLeastBuffers) throw Error(device_ + " has too few buffers");
  for (uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = make_buffer(i);
    if (control(descriptor_, VIDIOC_QUERYBUF, &buffer) < 0) fail("find a buffer");
    if (buffer.length < kImageBytes) throw Error(device_ + " has buffers that are too small");
    void* start = mmap(nullptr, buffer.length, PROT_READ, MAP_SHARED, descriptor_, buffer.m.offset);
    if (start == MAP_FAILED) fail("map a buffer");
    buffers_.push_back({static_cast<uint8_t*>(start), buffer.length});
  }
}

void V4l2Device::set_controls(const V4l2CameraSettings& settings) {
  for (const V4l2CameraSettings::Extension& extension : settings.extensions) {
    std::vector<uint8_t> value = extension.value;
    uvc_xu_control_query query{};
    query.unit = extension.unit;
    query.selector = extension.selector;
    query.query = UVC_SET_CUR;
    query.size = static_cast<uint16_t>(value.size());
    query.data = value.data();
    if (control(descriptor_, UVCIOC_CTRL_QUERY, &query) < 0) {
      problems_.push_back(device_ + " refuses selector " + std::to_string(extension.selector) +
                          " of extension unit " + std::to_string(extension.unit) + ": " +
                          std::strerror(errno));
    }
  }
  bool is_exposure_fixed = false;
  for (const V4l2CameraSettings::Control& setting : settings.controls) {
    v4l2_control value{setting.id, setting.value};
    if (control(descriptor_, VIDIOC_S_CTRL, &value) < 0) {
      problems_.push_back(device_ + " refuses " + setting.name + " " +
                          std::to_string(setting.value) + ": " + std::strerror(errno));
    } else if (setting.id == V4L2_CID_EXPOSURE_ABSOLUTE) {
      is_exposure_fixed = true;
      exposure_time_ = kExposureUnit * value.value;
    }
  }
  if (!is_exposure_fixed) exposure_time_ = 0;
}

void V4l2Device::queue(int buffer) {
  v4l2_buffer queued = make_buffer(static_cast<uint32_t>(buffer));
  if (control(descriptor_, VIDIOC_QBUF, &queued) < 0) fail("queue a buffer");
}

bool V4l2Device::receive() {
  bool has_new = false;
  while (true) {
    v4l2_buffer buffer = make_buffer(0);
    if (control(descriptor_, VIDIOC_DQBUF, &buffer) < 0) {
      if (errno == EAGAIN) return has_new;
      fail("receive an image");
    }
    const int index = static_cast<int>(buffer.index);
    if (buffer.index >= buffers_.size())
      throw Error(device_ + " names a buffer that it does not have");
    if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || buffer.bytesused != kImageBytes) {
      queue(index);
      continue;
    }
    // The previously newest buffer goes back to the driver.
    if (newest_ >= 0) queue(newest_);
    newest_ = index;
    has_new = true;
    const bool is_monotonic =
        (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    image_time_ = is_monotonic ? static_cast<double>(buffer.timestamp.tv_sec) +
                                     1e-6 * static_cast<double>(buffer.timestamp.tv_usec)
                               : monotonic_seconds();
  }
}

std::span<const uint8_t> V4l2Device::image() const {
  return {buffers_[static_cast<size_t>(newest_)].start, kImageBytes};
}

}  // namespace nao::camera
