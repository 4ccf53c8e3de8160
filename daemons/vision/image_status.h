#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "daemons/vision/camera_geometry.h"

namespace nao::vision {

/** What is wrong with an image; the order is that of vision_state_t's IMAGE_STATUS_*. */
enum class ImageStatus { kOk, kCovered, kOverexposed, kFrozen, kInverted };

/** "ok", "covered", "overexposed", "frozen", "inverted". */
const char* image_status_name(ImageStatus status);

/** Finds images that show nothing useful.
 *
 * - covered: nearly uniform and not green, or nearly black
 * - overexposed: most pixels are at the upper end of the range
 * - frozen: identical to the camera's images of the last 0.3 s; a sensor's noise makes each image
 *   of a working camera differ, so that this is only checked for cameras that have shown noise
 * - inverted: the field is above the horizon and not below it (an upside-down image). A camera that
 *   looks down so far that the horizon is not below its upper third sees the field above, and its
 *   robot's body or another robot below: nothing follows from that. */
class ImageStatusMonitor {
 public:
  /** @param camera  Name; each has its own history. @param utime  Microseconds.
   * @param is_moving  The camera has moved since its last image, so that equal images are an
   *   error even without noise. @param horizon  Its row in the middle of the image, pixels, for a
   *   camera that hangs as it should; nothing: unknown. */
  ImageStatus check(const cv::Mat& bgr, const std::string& camera, int64_t utime, bool is_moving,
                    const std::optional<double>& horizon = std::nullopt);

 private:
  struct History {
    uint64_t hash = 0;
    /** Of the first of the equal images. */
    int64_t utime = 0;
  };
  std::map<std::string, History> history_;
};

}  // namespace nao::vision
