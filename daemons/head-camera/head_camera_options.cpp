#include "daemons/head-camera/head_camera_options.h"

#include <cmath>

#include "common/error.h"
#include "daemons/head-camera/image_requests.h"
#include "robot_model/robot_model.h"

namespace nao::camera {
namespace {

/** Limit of each distortion coefficient. Chosen: above every lens in use; undistorted() checks
 * whether a smaller one still folds the image. */
constexpr double kMaxCoefficient = 2;
/** Limit of the noise, levels. Chosen: no object is recognizable above it. */
constexpr double kMaxNoise = 60;
/** Limit of the exposure, s: the interval between two images at 30 images a second. */
constexpr double kMaxExposure = 0.033;
/** Limit of the shadow map, texels. Chosen: finer than any image that is drawn here. */
constexpr int kMaxShadowSize = 4096;

}  // namespace

std::string HeadCameraOptions::camera_name(const RobotModel& model) const {
  if (!camera.empty()) return camera;
  if (model.cameras().empty()) throw ConfigError("the robot " + model.name() + " has no camera");
  return model.cameras().front().name;
}

void HeadCameraOptions::validate(const RobotModel& model) const {
  const std::string problem =
      check_request({camera_name(model), width, rate, quality}, model.cameras());
  if (!problem.empty()) throw ConfigError(problem);
  if (source != "v4l2" && !devices.empty()) {
    throw ConfigError("--device needs --source v4l2: rendered images come from no device");
  }
  if (source == "v4l2" && (noise > 0 || exposure > 0)) {
    throw ConfigError("--noise and --exposure are for rendered images; the source is v4l2");
  }
  if (shadow_size < 0 || shadow_size > kMaxShadowSize) {
    throw ConfigError("the shadow map size " + std::to_string(shadow_size) +
                      " is outside 0 to 4096 texels");
  }
  for (const double coefficient : distortion.coefficients()) {
    if (!(std::abs(coefficient) <= kMaxCoefficient)) {
      throw ConfigError("the distortion coefficient " + std::to_string(coefficient) +
                        " is outside -2 to 2");
    }
  }
  if (!(noise >= 0 && noise <= kMaxNoise)) {
    throw ConfigError("the noise " + std::to_string(noise) + " is outside 0 to 60 levels");
  }
  if (!(exposure >= 0 && exposure <= kMaxExposure)) {
    throw ConfigError("the exposure " + std::to_string(1e3 * exposure) + " is outside 0 to 33 ms");
  }
}

}  // namespace nao::camera
