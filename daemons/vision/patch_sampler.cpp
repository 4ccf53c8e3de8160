#include "daemons/vision/patch_sampler.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace nao::vision {
namespace {

/** Levels of the pyramid: a patch as wide as the image has pixels of 20 pixels. */
constexpr int kNumLevels = 5;
/** Distance of the centers, radii, and ratio of the radii, below which circles are the same.
 * Chosen: a third of what BallDetector's network corrects. */
constexpr float kSameCenter = 0.25f;
constexpr float kSameRadius = 1.25f;

}  // namespace

bool is_same(const Circle& a, const Circle& b) {
  const float lower = std::min(a.radius, b.radius);
  const float upper = std::max(a.radius, b.radius);
  return cv::norm(a.center - b.center) < kSameCenter * lower && upper < kSameRadius * lower;
}

PatchSampler::PatchSampler(const cv::Mat& bgr) {
  levels_ = {bgr};
  while (levels_.size() < kNumLevels) {
    const cv::Mat& last = levels_.back();
    if (last.cols < 2 || last.rows < 2) break;
    cv::Mat next;
    cv::resize(last, next, {last.cols / 2, last.rows / 2}, 0, 0, cv::INTER_AREA);
    levels_.push_back(next);
  }
}

cv::Mat PatchSampler::sample(const cv::Point2f& center, float half_width) const {
  // Pixels of the level for each pixel of the patch.
  double step = 2.0 * half_width / kSize;
  size_t level = 0;
  double x = center.x;
  double y = center.y;
  while (step >= 2 && level + 1 < levels_.size()) {
    step /= 2;
    // The center of pixel i of the next level lies between pixels 2 i and 2 i + 1.
    x = 0.5 * x - 0.25;
    y = 0.5 * y - 0.25;
    ++level;
  }
  const double offset = 0.5 * (kSize - 1) * step;
  const cv::Matx23d map(step, 0, x - offset, 0, step, y - offset);
  cv::Mat patch;
  cv::warpAffine(levels_[level], patch, map, {kSize, kSize},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT);
  return patch;
}

}  // namespace nao::vision
