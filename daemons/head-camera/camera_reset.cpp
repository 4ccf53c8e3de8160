#include "daemons/head-camera/camera_reset.h"

#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "common/error.h"

namespace nao::camera {
namespace {

/** Pause after each write, s, so that the held line acts as a reset. Chosen: far above the
 * milliseconds that a reset input needs. */
constexpr std::chrono::milliseconds kPause{100};

}  // namespace

void reset_cameras(const V4l2ResetSettings& settings) {
  const int bus = open(settings.bus.c_str(), O_RDWR | O_CLOEXEC);
  if (bus < 0) throw Error("cannot open " + settings.bus + ": " + std::strerror(errno));
  bool is_done = ioctl(bus, I2C_SLAVE, static_cast<unsigned long>(settings.address)) >= 0;
  for (const V4l2ResetSettings::Write& write : settings.writes) {
    i2c_smbus_data data{};
    data.byte = write.value;
    i2c_smbus_ioctl_data request{I2C_SMBUS_WRITE, write.chip_register, I2C_SMBUS_BYTE_DATA, &data};
    is_done = is_done && ioctl(bus, I2C_SMBUS, &request) >= 0;
    if (!is_done) break;
    std::this_thread::sleep_for(kPause);
  }
  const int fault = errno;
  close(bus);
  if (!is_done) throw Error("cannot write to " + settings.bus + ": " + std::strerror(fault));
}

}  // namespace nao::camera
