#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nao {
class RobotModel;
}

namespace nao::camera {

/** How one camera is read through Video4Linux2. */
struct V4l2CameraSettings {
  /** Camera name from the robot's description. */
  std::string camera;
  /** Device file. */
  std::string device;
  /** A control of the camera's USB extension unit, for which the kernel has no name. */
  struct Extension {
    uint8_t unit = 0;
    uint8_t selector = 0;
    std::vector<uint8_t> value;
  };
  std::vector<Extension> extensions;
  /** A control of the kernel, V4L2_CID_*. */
  struct Control {
    std::string name;
    uint32_t id = 0;
    int32_t value = 0;
  };
  std::vector<Control> controls;
};

/** How cameras that deliver nothing are reset: registers of a chip on an I2C bus. */
struct V4l2ResetSettings {
  /** Device file of the bus. */
  std::string bus;
  uint8_t address = 0;
  struct Write {
    uint8_t chip_register = 0;
    uint8_t value = 0;
  };
  /** In this order. */
  std::vector<Write> writes;
  /** Time until the cameras can be opened again, s. */
  double wait = 0;
};

struct V4l2Settings {
  std::vector<V4l2CameraSettings> cameras;
  /** A reset affects all cameras. */
  std::optional<V4l2ResetSettings> reset;

  /** Reads head_cameras.yaml of the robot's folder.
   * @param devices  Values of --device, CAMERA=FILE or FILE for the first camera: only these
   *   cameras are read, at these device files; the robot then needs no head_cameras.yaml.
   * @throws ConfigError  naming what is wrong. */
  static V4l2Settings load(const RobotModel& model, const std::vector<std::string>& devices);
};

}  // namespace nao::camera
