// Preloaded into a program, it stands for cameras of Video4Linux2 and for the I2C bus that resets
// them. It behaves as the kernel's documentation demands: calls in a wrong order fail as they would
// there.
//
// Environment: FAKE_V4L2_LOG, a file that gets one line for each call; FAKE_V4L2_FRAMES, a file
// with recorded YUYV images of 640x480, delivered in turn; FAKE_V4L2_HANG_AFTER, a number of images
// after which a camera delivers nothing until it is reset; FAKE_V4L2_FAIL_AFTER, one after which
// the first camera is lost once, as when its cable is pulled; FAKE_V4L2_DAMAGE, damages every fifth
// image. Devices: /fake/video-NAME, /fake/i2c.

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <linux/uvcvideo.h>
#include <linux/videodev2.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace {

constexpr uint32_t kWidth = 640;
constexpr uint32_t kHeight = 480;
constexpr size_t kBytes = size_t{2} * kWidth * kHeight;
/** Time between the start of an exposure and the delivery of the image, microseconds. */
constexpr int64_t kAge = 20000;

struct Camera {
  std::string name;
  bool has_format = false;
  bool is_streaming = false;
  std::vector<uint8_t*> buffers;
  /** Queued by the program, in order. */
  std::vector<uint32_t> queued;
  int num_images = 0;
};

std::mutex g_mutex;
std::map<int, Camera> g_cameras;
int g_bus = -1;
bool g_is_hanging = false;
bool g_has_hung = false;
bool g_has_failed = false;

const char* setting(const char* name) {
  return std::getenv(name);
}

void note(const std::string& line) {
  const char* path = setting("FAKE_V4L2_LOG");
  if (path == nullptr) return;
  std::ofstream(path, std::ios::app) << line << "\n";
}

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

const std::vector<uint8_t>& recorded() {
  static const std::vector<uint8_t> bytes = [] {
    std::ifstream file(setting("FAKE_V4L2_FRAMES"), std::ios::binary);
    return std::vector<uint8_t>(std::istreambuf_iterator<char>(file), {});
  }();
  return bytes;
}

int fault(int number) {
  errno = number;
  return -1;
}

/** @return -2 if the path is not of a fake device. */
int open_fake(const char* path) {
  const std::lock_guard lock(g_mutex);
  if (std::strcmp(path, "/fake/i2c") == 0) {
    g_bus = eventfd(0, EFD_CLOEXEC);
    return g_bus;
  }
  const char* prefix = "/fake/video-";
  if (std::strncmp(path, prefix, std::strlen(prefix)) != 0) return -2;
  const std::string name = path + std::strlen(prefix);
  if (name == "missing") return fault(ENOENT);
  const int descriptor = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
  g_cameras[descriptor].name = name;
  note(name + " open");
  return descriptor;
}

void set_timer(int descriptor, bool is_on) {
  // 30 images a second.
  const long period = is_on ? 33333333 : 0;
  const itimerspec timing{{0, period}, {0, period}};
  timerfd_settime(descriptor, 0, &timing, nullptr);
}

int request_buffers(Camera& camera, v4l2_requestbuffers& request) {
  if (!camera.has_format) return fault(EINVAL);
  if (camera.is_streaming || !camera.buffers.empty()) return fault(EBUSY);
  request.count = request.count < 3 ? request.count : 3;
  camera.buffers.assign(request.count, nullptr);
  return 0;
}

int dequeue(Camera& camera, int descriptor, v4l2_buffer& buffer) {
  if (!camera.is_streaming) return fault(EINVAL);
  uint64_t expirations = 0;
  if (read(descriptor, &expirations, sizeof expirations) < 0) return fault(EAGAIN);
  if (const char* limit = setting("FAKE_V4L2_FAIL_AFTER");
      limit != nullptr && !g_has_failed && camera.num_images >= std::atoi(limit)) {
    g_has_failed = true;
    return fault(ENODEV);
  }
  if (const char* limit = setting("FAKE_V4L2_HANG_AFTER");
      limit != nullptr && !g_has_hung && camera.num_images >= std::atoi(limit)) {
    g_has_hung = g_is_hanging = true;
  }
  if (g_is_hanging || camera.queued.empty()) return fault(EAGAIN);
  buffer.index = camera.queued.front();
  camera.queued.erase(camera.queued.begin());
  const std::vector<uint8_t>& bytes = recorded();
  const size_t num_frames = bytes.size() / kBytes;
  const size_t frame = static_cast<size_t>(camera.num_images) % num_frames;
  std::memcpy(camera.buffers[buffer.index], bytes.data() + frame * kBytes, kBytes);
  buffer.bytesused = kBytes;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const int64_t stamp = int64_t{1000000} * now.tv_sec + now.tv_nsec / 1000 - kAge;
  buffer.timestamp.tv_sec = stamp / 1000000;
  buffer.timestamp.tv_usec = stamp % 1000000;
  buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  const bool is_damaged = setting("FAKE_V4L2_DAMAGE") != nullptr && camera.num_images % 5 == 4;
  if (is_damaged) buffer.bytesused = kBytes / 2;
  note(camera.name + (is_damaged ? " damaged " : " image ") + std::to_string(stamp) + " " +
       std::to_string(frame));
  ++camera.num_images;
  return 0;
}

int control_camera(Camera& camera, int descriptor, unsigned long request, void* argument) {
  if (request == VIDIOC_DQBUF) {
    return dequeue(camera, descriptor, *static_cast<v4l2_buffer*>(argument));
  }
  if (request == VIDIOC_QBUF) {
    const uint32_t index = static_cast<v4l2_buffer*>(argument)->index;
    if (index >= camera.buffers.size() || camera.buffers[index] == nullptr) return fault(EINVAL);
    if (!camera.is_streaming) note(camera.name + " QBUF");
    camera.queued.push_back(index);
    return 0;
  }
  switch (request) {
    case VIDIOC_QUERYCAP: {
      note(camera.name + " QUERYCAP");
      auto& capability = *static_cast<v4l2_capability*>(argument);
      capability.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_DEVICE_CAPS;
      capability.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
      return 0;
    }
    case VIDIOC_S_FMT: {
      if (!camera.buffers.empty()) return fault(EBUSY);
      auto& pixels = static_cast<v4l2_format*>(argument)->fmt.pix;
      note(camera.name + " S_FMT " + std::to_string(pixels.width) + "x" +
           std::to_string(pixels.height) + " " +
           std::string(reinterpret_cast<const char*>(&pixels.pixelformat), 4));
      pixels.bytesperline = 2 * kWidth;
      pixels.sizeimage = kBytes;
      camera.has_format = true;
      return 0;
    }
    case VIDIOC_S_PARM: {
      if (camera.is_streaming) return fault(EBUSY);
      const auto& rate = static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe;
      note(camera.name + " S_PARM " + std::to_string(rate.numerator) + "/" +
           std::to_string(rate.denominator));
      return 0;
    }
    case VIDIOC_REQBUFS:
      note(camera.name + " REQBUFS");
      return request_buffers(camera, *static_cast<v4l2_requestbuffers*>(argument));
    case VIDIOC_QUERYBUF: {
      auto& buffer = *static_cast<v4l2_buffer*>(argument);
      if (buffer.index >= camera.buffers.size()) return fault(EINVAL);
      buffer.length = kBytes;
      buffer.m.offset = buffer.index * 0x100000;
      return 0;
    }
    case UVCIOC_CTRL_QUERY: {
      const auto& query = *static_cast<uvc_xu_control_query*>(argument);
      std::string value;
      for (int i = 0; i < query.size; ++i) value += " " + std::to_string(query.data[i]);
      note(camera.name + " UVC " + std::to_string(query.unit) + " " +
           std::to_string(query.selector) + value);
      return 0;
    }
    case VIDIOC_S_CTRL: {
      const auto& control = *static_cast<v4l2_control*>(argument);
      note(camera.name + " S_CTRL " + std::to_string(control.id) + " " +
           std::to_string(control.value));
      // Cameras without automatic hue answer in this way.
      return control.id == V4L2_CID_HUE_AUTO ? fault(EINVAL) : 0;
    }
    case VIDIOC_STREAMON:
      note(camera.name + " STREAMON");
      if (camera.queued.empty()) return fault(EINVAL);
      camera.is_streaming = true;
      set_timer(descriptor, true);
      return 0;
    case VIDIOC_STREAMOFF:
      note(camera.name + " STREAMOFF");
      camera.is_streaming = false;
      set_timer(descriptor, false);
      camera.queued.clear();
      return 0;
    default:
      note(camera.name + " unknown");
      return fault(ENOTTY);
  }
}

int control_bus(unsigned long request, void* argument) {
  if (request == I2C_SLAVE) {
    note("i2c address " + std::to_string(reinterpret_cast<uintptr_t>(argument)));
    return 0;
  }
  if (request != I2C_SMBUS) return fault(ENOTTY);
  const auto& write = *static_cast<i2c_smbus_ioctl_data*>(argument);
  note("i2c write " + std::to_string(write.command) + " " + std::to_string(write.data->byte));
  // The cameras come back when their reset lines are released.
  if (write.command == 1 && write.data->byte == 0x0c) g_is_hanging = false;
  return 0;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  const int fake = open_fake(path);
  if (fake != -2) return fake;
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return original<int (*)(const char*, int, ...)>("open")(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  const int fake = open_fake(path);
  if (fake != -2) return fake;
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return original<int (*)(const char*, int, ...)>("open64")(path, flags, mode);
}

int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  {
    const std::lock_guard lock(g_mutex);
    const auto camera = g_cameras.find(descriptor);
    if (camera != g_cameras.end()) {
      return control_camera(camera->second, descriptor, request, argument);
    }
    if (descriptor >= 0 && descriptor == g_bus) return control_bus(request, argument);
  }
  return original<int (*)(int, unsigned long, ...)>("ioctl")(descriptor, request, argument);
}

void* mmap(void* address, size_t length, int protection, int flags, int descriptor,
           off_t offset) noexcept {
  static const auto map = original<void* (*)(void*, size_t, int, int, int, off_t)>("mmap");
  // Memory is also mapped before and within the lock: only cameras' descriptors need it.
  if (descriptor < 0 || (flags & MAP_ANONYMOUS) != 0) {
    return map(address, length, protection, flags, descriptor, offset);
  }
  const std::lock_guard lock(g_mutex);
  const auto camera = g_cameras.find(descriptor);
  if (camera == g_cameras.end()) {
    return map(address, length, protection, flags, descriptor, offset);
  }
  const auto index = static_cast<size_t>(offset) / 0x100000;
  void* memory = map(nullptr, length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (index < camera->second.buffers.size()) {
    camera->second.buffers[index] = static_cast<uint8_t*>(memory);
  }
  return memory;
}

int close(int descriptor) {
  {
    const std::lock_guard lock(g_mutex);
    const auto camera = g_cameras.find(descriptor);
    if (camera != g_cameras.end()) {
      note(camera->second.name + " close");
      g_cameras.erase(camera);
    } else if (descriptor >= 0 && descriptor == g_bus) {
      g_bus = -1;
    }
  }
  return original<int (*)(int)>("close")(descriptor);
}

}  // extern "C"
