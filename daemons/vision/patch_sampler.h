#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace nao::vision {

/** A circle in the image, pixels. */
struct Circle {
  cv::Point2f center;
  float radius = 0;
};

/** Whether two circles are so near and so equal in size that their patches show the same. */
bool is_same(const Circle& a, const Circle& b);

/** Cuts square patches of any size out of an image, as input of a NeuralNetwork.
 *
 * The image is halved several times; a patch comes from the level whose pixels are the largest that
 * are not larger than those of the patch, so that nothing is skipped. */
class PatchSampler {
 public:
  /** Width and height of a patch, pixels. */
  static constexpr int kSize = 32;

  /** @param bgr  8 bits a color, blue first; must not change while this is used. */
  explicit PatchSampler(const cv::Mat& bgr);

  /** The image. */
  const cv::Mat& full() const { return levels_.front(); }
  /** The image at half of its size. */
  const cv::Mat& half() const { return levels_[1]; }
  /** The image at an eighth of its size: enough for statistics of all of it. */
  const cv::Mat& eighth() const { return levels_[3]; }

  /** @param half_width  Half width of the patch in the image, pixels. What lies outside of the
   * image is black.
   * @return kSize x kSize pixels, 8 bits a color, blue first. */
  cv::Mat sample(const cv::Point2f& center, float half_width) const;

 private:
  /** The image, a half, a quarter ... of its size. */
  std::vector<cv::Mat> levels_;
};

}  // namespace nao::vision
