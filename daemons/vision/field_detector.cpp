#include "daemons/vision/field_detector.h"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nao::vision {
namespace {

/** Range of the histogram of the green index; values outside count at its ends. */
constexpr float kLow = -0.1f;
constexpr float kHigh = 0.6f;
constexpr int kNumBins = 70;
/** A column of the field ends upwards where this many pixels of `other` in succession are not
 * green: more near the camera, where lines are thick, by this fraction of the row. Tuned on real
 * images: a line 0.4 m ahead is 27 pixels thick, banners behind the field are 25 high. */
constexpr int kGap = 12;
constexpr int kRowsPerGap = 6;

/** redness_of() a yellow ball, and least difference of a ball's from the field's. */
constexpr float kYellow = 0.02f;
constexpr float kLeastAway = 0.08f;
/** Distance between the pixels from which the field's redness is computed. */
constexpr int kYellowStep = 4;

using Histogram = std::array<int, kNumBins>;

int bin_of(float index) {
  const float position = (index - kLow) / (kHigh - kLow) * kNumBins;
  return std::clamp(static_cast<int>(position), 0, kNumBins - 1);
}

float value_of(int bin) {
  return kLow + (static_cast<float>(bin) + 0.5f) * (kHigh - kLow) / kNumBins;
}

/** Saturation from green towards red, -1 to 1; 0 of greys and about 0 of yellow, which is as far
 * from grey towards green as a field. */
float redness_of(float blue, float green, float red) {
  return (red - green) / (blue + green + red + 6);
}

/** The image at half of its size, each color on its own: loops over planes are vectorized. */
struct Planes {
  explicit Planes(const cv::Mat& bgr) { cv::split(bgr, planes.data()); }

  std::array<cv::Mat_<uint8_t>, 3> planes;
  const cv::Mat_<uint8_t>& blue = planes[0];
  const cv::Mat_<uint8_t>& green = planes[1];
  const cv::Mat_<uint8_t>& red = planes[2];
};

/** Mean over 3x3 pixels, to the nearest level; beyond the border the image is mirrored. cv::blur()
 * takes five times as long for three colors. */
void smooth(const cv::Mat& bgr, cv::Mat_<cv::Vec3b>& out) {
  out.create(bgr.size());
  const int length = 3 * bgr.cols;
  // A pixel more on both sides.
  std::vector<uint16_t> sums(static_cast<size_t>(length) + 6);
  for (int y = 0; y < bgr.rows; ++y) {
    const uint8_t* above = bgr.ptr(y > 0 ? y - 1 : 1);
    const uint8_t* middle = bgr.ptr(y);
    const uint8_t* below = bgr.ptr(y + 1 < bgr.rows ? y + 1 : y - 1);
    uint16_t* sum = sums.data() + 3;
    for (int i = 0; i < length; ++i) {
      sum[i] = static_cast<uint16_t>(above[i] + middle[i] + below[i]);
    }
    for (int i = 0; i < 3; ++i) {
      sum[i - 3] = sum[i + 3];
      sum[length + i] = sum[length - 6 + i];
    }
    uint8_t* target = out.ptr(y);
    for (int i = 0; i < length; ++i) {
      const auto total = static_cast<uint16_t>(sum[i - 3] + sum[i] + sum[i + 3] + 4);
      // total / 9, exact up to 9 * 255 + 4.
      target[i] = static_cast<uint8_t>(total * 7282U >> 16);
    }
  }
}

// Returns the bin that divides the histogram into two classes with the largest variance between
// them.
/** N. Otsu, "A threshold selection method from gray-level histograms", IEEE SMC 1979. */
int otsu(const Histogram& histogram) {
  double total = 0;
  double sum = 0;
  for (int bin = 0; bin < kNumBins; ++bin) {
    total += histogram[bin];
    sum += static_cast<double>(bin) * histogram[bin];
  }
  double below = 0;
  double sum_below = 0;
  double best = -1;
  int threshold = 0;
  for (int bin = 0; bin + 1 < kNumBins; ++bin) {
    below += histogram[bin];
    sum_below += static_cast<double>(bin) * histogram[bin];
    const double above = total - below;
    if (below == 0 || above == 0) continue;
    const double difference = sum_below / below - (sum - sum_below) / above;
    // Variance between the classes, up to a constant factor.
    const double variance = below * above * difference * difference;
    if (variance > best) {
      best = variance;
      threshold = bin;
    }
  }
  return threshold;
}

void find_color(const cv::Mat_<float>& index, const VisionParameters::FieldDetector& parameters,
                FieldView& view) {
  const auto least = static_cast<float>(parameters.least_threshold);
  const auto greatest = static_cast<float>(parameters.greatest_threshold);
  Histogram histogram{};
  for (int y = 0; y < index.rows; y += 2) {
    for (int x = 0; x < index.cols; x += 2) ++histogram[bin_of(index(y, x))];
  }
  view.threshold = std::clamp(value_of(otsu(histogram)), least, greatest);
  // Median green index of the pixels above the threshold: the field's own green. Every second pixel
  // was counted.
  const int first = bin_of(view.threshold);
  int above = 0;
  for (int bin = first; bin < kNumBins; ++bin) above += histogram[bin];
  int count = 0;
  int bin = first;
  while (bin < kNumBins - 1 && 2 * (count += histogram[bin]) < above) ++bin;
  view.index = std::max(value_of(bin), 1.3f * view.threshold);
  // If only field is in view, Otsu's method divides the field itself.
  view.threshold = std::clamp(view.threshold, least,
                              static_cast<float>(parameters.greatest_fraction) * view.index);
}

/** The level at or below a number, 0 to 255. */
int level(float number) {
  return static_cast<int>(std::min(std::max(number, 0.0f), 255.0f));
}

/** Sets other_or_yellow. */
void add_yellow(const Planes& half, FieldView& view) {
  view.other_or_yellow.create(view.other.size());
  std::array<int, 3> field{};
  for (int y = 0; y < view.other.rows; y += kYellowStep) {
    for (int x = 0; x < view.other.cols; x += kYellowStep) {
      if (view.other(y, x) >= 128) continue;
      for (int i = 0; i < 3; ++i) field[i] += half.planes[i](y, x);
    }
  }
  const float redness = redness_of(static_cast<float>(field[0]), static_cast<float>(field[1]),
                                   static_cast<float>(field[2]));
  // Linear from the field's redness (0) to that of yellow (255), or of orange on a pale field.
  const float slope = 255 / std::max(kYellow - redness, kLeastAway);
  const int width = view.other.cols;
  for (int y = 0; y < view.other.rows; ++y) {
    const uint8_t* blue = half.blue[y];
    const uint8_t* green = half.green[y];
    const uint8_t* red = half.red[y];
    const uint8_t* other = view.other[y];
    uint8_t* target = view.other_or_yellow[y];
    for (int x = 0; x < width; ++x) {
      const int yellow = level(slope * (redness_of(blue[x], green[x], red[x]) - redness));
      // Green is never yellow, on however green a field.
      const int least = 8 * red[x] < 7 * green[x] ? 0 : yellow;
      target[x] = static_cast<uint8_t>(std::max<int>(other[x], least));
    }
  }
}

/** Upper convex hull of the points (column, row), rows counting downwards; interpolated. */
// The field is convex, and so is its border: robots and lines that cut into it are bridged.
void raise_to_hull(std::vector<int>& top, int height) {
  std::vector<cv::Point2d> hull;
  for (size_t column = 0; column < top.size(); column += 4) {
    if (top[column] >= height) continue;
    const cv::Point2d point(static_cast<double>(column), top[column]);
    while (hull.size() >= 2) {
      const cv::Point2d a = hull[hull.size() - 1] - hull[hull.size() - 2];
      const cv::Point2d b = point - hull[hull.size() - 2];
      // Removes the middle of three points that lies below the line between its neighbors.
      if (a.x * b.y - a.y * b.x > 0) break;
      hull.pop_back();
    }
    hull.push_back(point);
  }
  for (size_t i = 0; i + 1 < hull.size(); ++i) {
    const double slope = (hull[i + 1].y - hull[i].y) / (hull[i + 1].x - hull[i].x);
    for (int x = static_cast<int>(hull[i].x); x <= static_cast<int>(hull[i + 1].x); ++x) {
      top[x] = static_cast<int>(std::lround(hull[i].y + slope * (x - hull[i].x)));
    }
  }
}

void find_border(const CameraGeometry& geometry, FieldView& view) {
  const int height = view.other.rows;
  view.top.assign(view.other.cols, height);
  for (int x = 0; x < view.other.cols; x += 4) {
    int first = 0;
    // Nothing above the horizon is on the field.
    if (const auto horizon = geometry.horizon_row(2 * x)) {
      first = std::clamp(static_cast<int>(*horizon / 2) - 4, 0, height);
    }
    // The search goes upwards, since there may be green things behind the field.
    int gap = 0;
    for (int y = height - 1; y >= first && gap <= kGap + y / kRowsPerGap; --y) {
      // Two rows in succession: single green pixels are noise.
      const bool is_green = view.other(y, x) < 128 && view.other(std::max(0, y - 1), x) < 128;
      gap = is_green ? 0 : gap + 1;
      if (is_green) view.top[x] = y - (y > 0);
    }
  }
  // Columns without field keep the height, so that their neighbors decide.
  raise_to_hull(view.top, height);
}

}  // namespace

FieldView FieldDetector::detect(const cv::Mat& bgr, const CameraGeometry& geometry) const {
  FieldView view;
  // Smoothing before the color is judged: noise would scatter the green index.
  smooth(bgr, view.smooth);
  cv::Mat_<cv::Vec3b> half;
  cv::resize(view.smooth, half, {bgr.cols / 2, bgr.rows / 2}, 0, 0, cv::INTER_AREA);
  const Planes planes(half);
  const int width = half.cols;
  cv::Mat_<float> index(half.size());
  for (int y = 0; y < half.rows; ++y) {
    const uint8_t* blue = planes.blue[y];
    const uint8_t* green = planes.green[y];
    const uint8_t* red = planes.red[y];
    float* target = index[y];
    for (int x = 0; x < width; ++x) target[x] = green_index(blue[x], green[x], red[x]);
  }
  find_color(index, parameters_, view);
  view.other.create(half.rows, half.cols);
  // Linear between the field's index (0) and that of grey (255); 128 at the threshold.
  const float threshold = view.threshold;
  const float slope = 127.0f / (view.index - threshold);
  int num_green = 0;
  for (int y = 0; y < half.rows; ++y) {
    const float* source = index[y];
    uint8_t* target = view.other[y];
    for (int x = 0; x < width; ++x) {
      const int other = level(128.0f + slope * (threshold - source[x]));
      target[x] = static_cast<uint8_t>(other);
      num_green += other < 128;
    }
  }
  view.fraction = static_cast<double>(num_green) / static_cast<double>(half.total());
  add_yellow(planes, view);
  find_border(geometry, view);
  return view;
}

}  // namespace nao::vision
