#include "daemons/vision/image_status.h"

#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "daemons/vision/field_detector.h"

namespace nao::vision {
namespace {

bool are_equal(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  const size_t row_size = a.cols * a.elemSize();
  for (int y = 0; y < a.rows; ++y) {
    if (std::memcmp(a.ptr(y), b.ptr(y), row_size) != 0) return false;
  }
  return true;
}

/** Fraction of the rows from `first` to `last` whose green index is above `least`. */
double green_fraction(const cv::Mat_<cv::Vec3b>& image, int first, int last, double least) {
  int num_green = 0;
  for (int y = first; y < last; ++y) {
    for (int x = 0; x < image.cols; ++x) num_green += green_index(image(y, x)) > least;
  }
  return static_cast<double>(num_green) / ((last - first) * image.cols);
}

}  // namespace

const char* image_status_name(ImageStatus status) {
  switch (status) {
    case ImageStatus::kOk:
      return "ok";
    case ImageStatus::kCovered:
      return "covered";
    case ImageStatus::kOverexposed:
      return "overexposed";
    case ImageStatus::kFrozen:
      return "frozen";
    case ImageStatus::kInverted:
      return "inverted";
  }
  return "";
}

bool ImageStatusMonitor::is_frozen(const cv::Mat& bgr, const std::string& camera, int64_t utime,
                                   const std::optional<Eigen::Isometry3d>& pose_camera_in_heading) {
  History& first = history_[camera];
  if (utime < first.utime || !are_equal(bgr, first.bgr) || !first.pose_camera_in_heading ||
      !pose_camera_in_heading) {
    bgr.copyTo(first.bgr);
    first.utime = utime;
    first.pose_camera_in_heading = pose_camera_in_heading;
    return false;
  }
  const Eigen::Isometry3d movement =
      first.pose_camera_in_heading->inverse() * *pose_camera_in_heading;
  return utime - first.utime >= std::llround(1e6 * parameters_.frozen_time) &&
         (movement.translation().norm() > parameters_.frozen_distance ||
          Eigen::AngleAxisd(movement.linear()).angle() > parameters_.frozen_angle);
}

// The first state that holds: overexposed, covered, frozen, inverted; otherwise ok. Detectors run
// on images that are ok only.
ImageStatus ImageStatusMonitor::check(
    const PatchSampler& image, const std::string& camera, int64_t utime,
    const std::optional<Eigen::Isometry3d>& pose_camera_in_heading,
    const std::optional<double>& horizon) {
  const cv::Mat_<cv::Vec3b> small = image.eighth();
  const bool may_be_frozen = is_frozen(image.full(), camera, utime, pose_camera_in_heading);

  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(small, mean, deviation);
  const double brightness = (mean[0] + mean[1] + mean[2]) / 3;
  cv::Mat_<uint8_t> grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  const int num_white = cv::countNonZero(grey >= parameters_.white_level);
  if (num_white > parameters_.white_fraction * static_cast<double>(grey.total())) {
    return ImageStatus::kOverexposed;
  }
  const double green = green_fraction(small, 0, small.rows, parameters_.green);
  const double spread = std::max({deviation[0], deviation[1], deviation[2]});
  // An image that is uniformly green is a field seen from near, not a covered lens.
  if (brightness < parameters_.dark_mean ||
      (spread < parameters_.uniform_deviation && green < 0.5)) {
    return ImageStatus::kCovered;
  }
  if (may_be_frozen && spread >= parameters_.uniform_deviation) return ImageStatus::kFrozen;
  // There is field above and none below: the camera hangs upside down.
  if (horizon && *horizon < image.full().rows / 3.0) return ImageStatus::kOk;
  const double upper = green_fraction(small, 0, small.rows / 3, parameters_.green);
  const double lower =
      green_fraction(small, small.rows - small.rows / 3, small.rows, parameters_.green);
  if (upper > 0.7 && lower < 0.15) return ImageStatus::kInverted;
  return ImageStatus::kOk;
}

}  // namespace nao::vision
