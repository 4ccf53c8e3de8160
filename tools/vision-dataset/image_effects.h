#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "common/random.h"

namespace nao::vision {

/** Effects of a real camera on an image: motion blur, focus, exposure, white balance, noise. */
struct ImageEffects {
  /** Length of the motion blur, pixels, and its direction, rad. */
  double blur = 0;
  double blur_angle = 0;
  /** Standard deviation of the blur of a lens out of focus, pixels. */
  double defocus = 0;
  /** Strength of the camera's sharpening: factor on what a blur of 1 pixel takes away. */
  double sharpening = 0;
  /** Factors on blue, green, red: exposure times white balance. */
  std::array<double, 3> gain{1, 1, 1};
  /** Added before the gain: stray light, levels of 255. */
  double veil = 0;
  /** Light of a lamp or window that lens or carpet reflects: middle and standard deviations,
   * pixels, and levels of 255 in the middle, added before noise. */
  cv::Point2d glare_center;
  cv::Point2d glare_size{1, 1};
  double glare = 0;
  /** Factor on the saturation. */
  double saturation = 1;
  /** Standard deviation of the noise, levels of 255. */
  double noise = 0;
  /** JPEG quality. */
  int quality = 85;
  uint64_t noise_seed = 0;

  /** White balance, saturation and stray light of a place. */
  static ImageEffects of_place(Random& random);
  /** Adds what differs between images of a place. */
  void vary(Random& random);
  /** Applies all of them except the compression. */
  void apply(cv::Mat& bgr) const;
};

}  // namespace nao::vision
