#include "daemons/vision/image_status.h"

#include <opencv2/imgproc.hpp>

#include "daemons/vision/field_detector.h"

namespace nao::vision {
namespace {

/** Side by which the image is reduced: the statistics need no more. */
constexpr int kWidth = 64;
constexpr int kHeight = 48;
/** Levels of 255. A covered lens shows a gradient at most; a hall in the dark has mean 20 and more.
 * Chosen on rendered images. */
constexpr double kUniformDeviation = 9;
constexpr double kDarkMean = 12;
constexpr double kWhiteLevel = 250;
constexpr double kWhiteFraction = 0.6;
/** Green index of a field, below that of the palest carpet. */
constexpr float kGreen = 0.08f;
/** Equal images for this long are frozen, microseconds: five images at 15 images a second. */
constexpr int64_t kFrozenTime = 300000;

/** FNV-1a over every byte of the reduced image. */
uint64_t hash_of(const cv::Mat& image) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (int y = 0; y < image.rows; ++y) {
    const uint8_t* row = image.ptr(y);
    for (size_t i = 0; i < image.cols * image.elemSize(); ++i) {
      hash = (hash ^ row[i]) * 0x100000001b3u;
    }
  }
  return hash;
}

/** Fraction of the rows from `first` to `last` that is green. */
double green_fraction(const cv::Mat_<cv::Vec3b>& image, int first, int last) {
  int num_green = 0;
  for (int y = first; y < last; ++y) {
    for (int x = 0; x < image.cols; ++x) num_green += green_index(image(y, x)) > kGreen;
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

// The first state that holds: overexposed, covered, frozen, inverted; otherwise ok. Detectors run
// on images that are ok only.
ImageStatus ImageStatusMonitor::check(const cv::Mat& bgr, const std::string& camera, int64_t utime,
                                      bool is_moving, const std::optional<double>& horizon) {
  cv::Mat_<cv::Vec3b> small;
  cv::resize(bgr, small, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
  const uint64_t hash = hash_of(small);
  History& history = history_[camera];
  // A robot that stands still may see the same image for long; only while it moves must the image
  // change.
  if (hash != history.hash || utime < history.utime || !is_moving) history = {hash, utime};

  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(small, mean, deviation);
  const double brightness = (mean[0] + mean[1] + mean[2]) / 3;
  cv::Mat_<uint8_t> grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  const int num_white = cv::countNonZero(grey >= kWhiteLevel);
  if (num_white > kWhiteFraction * static_cast<double>(grey.total())) {
    return ImageStatus::kOverexposed;
  }
  const double green = green_fraction(small, 0, kHeight);
  const double spread = std::max({deviation[0], deviation[1], deviation[2]});
  // An image that is uniformly green is a field seen from near, not a covered lens.
  if (brightness < kDarkMean || (spread < kUniformDeviation && green < 0.5)) {
    return ImageStatus::kCovered;
  }
  if (utime - history.utime >= kFrozenTime) return ImageStatus::kFrozen;
  // Field above and none below: the camera hangs upside down.
  if (horizon && *horizon < bgr.rows / 3.0) return ImageStatus::kOk;
  const double upper = green_fraction(small, 0, kHeight / 3);
  const double lower = green_fraction(small, kHeight - kHeight / 3, kHeight);
  if (upper > 0.7 && lower < 0.15) return ImageStatus::kInverted;
  return ImageStatus::kOk;
}

}  // namespace nao::vision
