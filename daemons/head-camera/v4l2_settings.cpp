#include "daemons/head-camera/v4l2_settings.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "common/yaml_entry.h"
#include "robot_model/robot_model.h"

namespace nao::camera {
namespace {

/** Names that a file may use, as v4l2-ctl prints them for recent kernels. */
constexpr std::array<std::pair<const char*, uint32_t>, 15> kControls{{
    {"brightness", V4L2_CID_BRIGHTNESS},
    {"contrast", V4L2_CID_CONTRAST},
    {"saturation", V4L2_CID_SATURATION},
    {"hue", V4L2_CID_HUE},
    {"hue_automatic", V4L2_CID_HUE_AUTO},
    {"sharpness", V4L2_CID_SHARPNESS},
    {"gain", V4L2_CID_GAIN},
    {"white_balance_automatic", V4L2_CID_AUTO_WHITE_BALANCE},
    {"white_balance_temperature", V4L2_CID_WHITE_BALANCE_TEMPERATURE},
    {"auto_exposure", V4L2_CID_EXPOSURE_AUTO},
    {"exposure_time_absolute", V4L2_CID_EXPOSURE_ABSOLUTE},
    {"focus_automatic_continuous", V4L2_CID_FOCUS_AUTO},
    {"focus_absolute", V4L2_CID_FOCUS_ABSOLUTE},
    {"power_line_frequency", V4L2_CID_POWER_LINE_FREQUENCY},
    {"backlight_compensation", V4L2_CID_BACKLIGHT_COMPENSATION},
}};
/** Greatest address on an I2C bus, which has 7 bits. */
constexpr int kMaxAddress = 127;

int integer(const YamlEntry& entry, int least, int greatest) {
  const double value = entry.number();
  if (value != std::floor(value) || value < least || value > greatest) {
    entry.fail("must be a whole number from " + std::to_string(least) + " to " +
               std::to_string(greatest));
  }
  return static_cast<int>(value);
}

uint8_t byte(const YamlEntry& entry) {
  return static_cast<uint8_t>(integer(entry, 0, 255));
}

std::vector<V4l2CameraSettings::Control> read_controls(const YamlEntry& map) {
  std::vector<V4l2CameraSettings::Control> controls;
  for (const auto& [name, value] : map.entries()) {
    const auto* known =
        std::find_if(kControls.begin(), kControls.end(),
                     [&name = name](const auto& control) { return name == control.first; });
    if (known == kControls.end()) {
      std::string names;
      for (const auto& control : kControls) names += std::string(" ") + control.first;
      value.fail("is not a control; there are:" + names);
    }
    controls.push_back({name, known->second, integer(value, INT16_MIN, 1 << 20)});
  }
  return controls;
}

std::vector<V4l2CameraSettings::Extension> read_extensions(const YamlEntry& list) {
  std::vector<V4l2CameraSettings::Extension> extensions;
  for (const YamlEntry& entry : list.items()) {
    entry.allow_only({"unit", "selector", "value"});
    V4l2CameraSettings::Extension extension{byte(entry.at("unit")), byte(entry.at("selector")), {}};
    for (const YamlEntry& value : entry.at("value").items()) extension.value.push_back(byte(value));
    if (extension.value.empty()) entry.at("value").fail("must have at least one byte");
    extensions.push_back(std::move(extension));
  }
  return extensions;
}

void check_camera(const RobotModel& model, const std::string& name) {
  std::string names;
  for (const CameraModel& camera : model.cameras()) {
    if (camera.name == name) return;
    names += (names.empty() ? "" : ", ") + camera.name;
  }
  throw ConfigError("the robot has no camera \"" + name + "\"; its cameras are: " + names);
}

V4l2Settings read_file(const RobotModel& model, const std::filesystem::path& path) {
  const YamlEntry file = YamlEntry::load<ConfigError>(path);
  file.allow_only({"cameras", "controls", "reset"});
  V4l2Settings settings;
  for (const YamlEntry& entry : file.at("cameras").items()) {
    entry.allow_only({"name", "device", "extension_controls"});
    V4l2CameraSettings camera;
    camera.camera = entry.at("name").text();
    check_camera(model, camera.camera);
    camera.device = entry.at("device").text();
    if (entry.has("extension_controls")) {
      camera.extensions = read_extensions(entry.at("extension_controls"));
    }
    if (file.has("controls")) camera.controls = read_controls(file.at("controls"));
    settings.cameras.push_back(std::move(camera));
  }
  if (file.has("reset")) {
    const YamlEntry reset = file.at("reset");
    reset.allow_only({"bus", "address", "writes", "wait"});
    V4l2ResetSettings& values = settings.reset.emplace();
    values.bus = reset.at("bus").text();
    values.address = static_cast<uint8_t>(integer(reset.at("address"), 0, kMaxAddress));
    values.wait = reset.at("wait").not_negative();
    for (const YamlEntry& write : reset.at("writes").items()) {
      write.allow_only({"register", "value"});
      values.writes.push_back({byte(write.at("register")), byte(write.at("value"))});
    }
  }
  return settings;
}

}  // namespace

V4l2Settings V4l2Settings::load(const RobotModel& model, const std::vector<std::string>& devices) {
  const std::filesystem::path path = model.folder() / "head_cameras.yaml";
  V4l2Settings settings;
  if (std::filesystem::exists(path)) {
    settings = read_file(model, path);
  } else if (devices.empty()) {
    throw ConfigError("there is no " + path.string() +
                      ", which names the cameras' devices; give another robot by --model, or a "
                      "device by --device CAMERA=FILE");
  }
  if (devices.empty()) return settings;
  std::vector<V4l2CameraSettings> chosen;
  for (const std::string& text : devices) {
    const size_t sign = text.find('=');
    V4l2CameraSettings camera;
    if (sign == std::string::npos && model.cameras().empty()) {
      throw ConfigError("the robot " + model.name() + " has no camera");
    }
    camera.camera = sign == std::string::npos ? model.cameras().front().name : text.substr(0, sign);
    check_camera(model, camera.camera);
    for (const V4l2CameraSettings& known : settings.cameras) {
      if (known.camera == camera.camera) camera = known;
    }
    camera.device = sign == std::string::npos ? text : text.substr(sign + 1);
    if (camera.device.empty()) throw ConfigError("--device " + text + " names no device file");
    chosen.push_back(std::move(camera));
  }
  settings.cameras = std::move(chosen);
  return settings;
}

}  // namespace nao::camera
