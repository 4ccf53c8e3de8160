#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/vision_parameters.h"

namespace nao::vision {

/** Saturation towards green of a color: (2 G - R - B) / (R + G + B), -1 to 2; 0 of greys. It does
 * not depend on the brightness, so that a field in shadow and in light have similar values. */
inline float green_index(int blue, int green, int red) {
  const int sum = blue + green + red + 6;  // the 6 makes dark noise count as grey
  return static_cast<float>(2 * green - blue - red) / static_cast<float>(sum);
}
inline float green_index(const cv::Vec3b& bgr) {
  return green_index(bgr[0], bgr[1], bgr[2]);
}

/** Mean of red and blue, 0 to 255: in it white differs more from a green carpet than in the
 * luminance. */
inline float whiteness(const cv::Vec3b& bgr) {
  return 0.5f * static_cast<float>(bgr[0] + bgr[2]);
}

/** An image with the field found in it. */
struct FieldView {
  /** The image, smoothed over 3x3 pixels. */
  cv::Mat_<cv::Vec3b> smooth;
  /** Half the size: 255 where the pixel is not of the field's color, 0 where it is, between them
   * for a mixture; 8 bits. */
  cv::Mat_<uint8_t> other;
  /** As `other`, where yellow is as far from the field as grey is. */
  cv::Mat_<uint8_t> other_or_yellow;
  /** green_index() of the field, and the least one that counts as field. */
  float index = 0;
  float threshold = 0;
  /** Fraction of the image that is field, 0 to 1. */
  double fraction = 0;
  /** First row of the field in each column of `other`; its height where the column has none. */
  std::vector<int> top;

  /** The pixel (of the full image) lies inside of the field's border. */
  bool is_inside(float x, float y) const {
    const int column = std::clamp(static_cast<int>(x / 2), 0, other.cols - 1);
    return y / 2 >= static_cast<float>(top[column]);
  }
  bool is_green(const cv::Vec3b& bgr) const { return green_index(bgr) > threshold; }
};

/** Finds the field's color, its region and its border in an image.
 *
 * The color's threshold comes from the image: Otsu's threshold of the green index. The border is
 * the upper convex hull of where the columns stop being green upwards, since a field is convex and
 * objects on it hide parts of its border. */
class FieldDetector {
 public:
  explicit FieldDetector(
      const VisionParameters::FieldDetector& parameters = VisionParameters::load().field_detector)
      : parameters_(parameters) {}

  FieldView detect(const cv::Mat& bgr, const CameraGeometry& geometry) const;

 private:
  VisionParameters::FieldDetector parameters_;
};

}  // namespace nao::vision
