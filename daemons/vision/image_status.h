#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/patch_sampler.h"
#include "daemons/vision/vision_parameters.h"

namespace nao::vision {

/** Fault of an image, in the order of vision_state_t's IMAGE_STATUS_*. */
enum class ImageStatus { kOk, kCovered, kOverexposed, kFrozen, kInverted };

/** "ok", "covered", "overexposed", "frozen", "inverted". */
const char* image_status_name(ImageStatus status);

/** Finds images that show nothing useful.
 *
 * - covered: nearly uniform and not green, or nearly black
 * - overexposed: most pixels are at the upper end of the range
 * - frozen: identical, byte by byte, to the camera's images of at least the last 0.3 s, though the
 *   camera has moved or turned since the first of them by more than such images allow. A camera
 *   that does not move may send the same image for a long time, and one near a carpet sees a single
 *   color.
 * - inverted: the field is above the horizon and not below it (an upside-down image). A camera that
 *   looks down so far that the horizon is not below its upper third sees the field above, and its
 *   robot's body or another robot below, from which nothing can be concluded. */
class ImageStatusMonitor {
 public:
  explicit ImageStatusMonitor(
      const VisionParameters::ImageStatus& parameters = VisionParameters::load().image_status)
      : parameters_(parameters) {}

  /** @param camera  Name; each has its own history. @param utime  Microseconds.
   * @param pose_camera_in_heading  See VisionInput; nothing: unknown, and no image is frozen.
   * @param horizon  Its row in the middle of the image, pixels, for a camera that hangs as it
   *   should; nothing: unknown. */
  ImageStatus check(const PatchSampler& image, const std::string& camera, int64_t utime,
                    const std::optional<Eigen::Isometry3d>& pose_camera_in_heading,
                    const std::optional<double>& horizon = std::nullopt);

 private:
  /** The first of equal images. */
  struct History {
    cv::Mat bgr;
    int64_t utime = 0;
    std::optional<Eigen::Isometry3d> pose_camera_in_heading;
  };

  /** The image is one of equal ones that a moving camera cannot take. Remembers it if it is not. */
  bool is_frozen(const cv::Mat& bgr, const std::string& camera, int64_t utime,
                 const std::optional<Eigen::Isometry3d>& pose_camera_in_heading);

  VisionParameters::ImageStatus parameters_;
  std::map<std::string, History> history_;
};

}  // namespace nao::vision
