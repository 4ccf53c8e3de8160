#include "daemons/vision/line_points.h"

namespace nao::vision {
namespace {

/** Widest crossing, pixels: a line one foot length ahead of the robot seen at a flat angle. */
constexpr int kMostLineWidth = 110;
/** Green pixels before and after a crossing. */
constexpr int kMargin = 3;
/** Mixed pixels, neither line nor field, that may lie at the edges of a crossing. */
constexpr int kMixed = 8;
/** Pixels in succession that look like field and end a crossing: single ones in a blurred, green
 * tinted line are noise. Tuned on real images. */
constexpr int kEnd = 3;
/** Weight of a new pixel in the mean of the field's level; small, so that the blurred edge of a
 * line does not raise it. */
constexpr float kWeight = 0.08f;

/** One scan line. */
class Scan {
 public:
  Scan(const FieldView& view, const VisionParameters::LinePoints& parameters, cv::Point start,
       cv::Point step, int length, std::vector<LinePoint>& points)
      : view_(view),
        contrast_(static_cast<float>(parameters.contrast)),
        index_fraction_(static_cast<float>(parameters.index_fraction)),
        drop_(static_cast<float>(parameters.drop)),
        start_(start),
        step_(step),
        pixels_(view.smooth.ptr(start.y, start.x)),
        pixel_step_(static_cast<std::ptrdiff_t>(step.y * view.smooth.step[0] +
                                                step.x * view.smooth.step[1])),
        length_(length),
        points_(points) {}

  // State machine along the scan line: field (levels are learnt), crossing (first_ >= 0), and what
  // is neither. A crossing counts only between two stretches of field.
  void run() {
    for (int i = 0; i < length_; ++i) {
      const cv::Vec3b& color = at(i);
      const float index = green_index(color);
      const float white = whiteness(color);
      const bool is_line = num_green_ >= kMargin && white > level_ + contrast_ &&
                           index < index_fraction_ * level_index_;
      if (first_ >= 0) {
        // As bright as before the field may be in another light than that before the line.
        const bool is_green = index > view_.threshold;
        peak_ = std::max(peak_, white);
        follow(i, is_line && !(is_green && white < peak_ - least_drop()), is_green);
      } else if (is_line) {
        first_ = i;
        peak_ = white;
        num_mixed_ = 0;
        num_end_ = 0;
      } else if (index > view_.threshold) {
        num_mixed_ = 0;
        // The first pixels form a plain mean, later ones an exponential one.
        const float weight =
            num_green_ < 1 / kWeight - 1 ? 1.0f / static_cast<float>(num_green_ + 1) : kWeight;
        level_ += weight * (white - level_);
        level_index_ += weight * (index - level_index_);
        ++num_green_;
      } else if (++num_mixed_ > kMixed) {
        num_green_ = 0;
      }
    }
  }

 private:
  const cv::Vec3b& at(int i) const {
    return *reinterpret_cast<const cv::Vec3b*>(pixels_ + i * pixel_step_);
  }

  float least_drop() const { return std::max(contrast_, drop_ * (peak_ - level_)); }

  void follow(int i, bool is_line, bool is_green) {
    if (is_line) {
      num_mixed_ = 0;
      num_end_ = 0;
      if (i - first_ > kMostLineWidth) abandon();
    } else if (is_green) {
      if (++num_end_ < kEnd) return;
      close(i + 1 - num_end_ - num_mixed_);
      // What follows is a new stretch of field, perhaps in another light.
      abandon();
    } else {
      // Green pixels between mixed ones are mixed too.
      num_mixed_ += 1 + num_end_;
      num_end_ = 0;
      if (num_mixed_ > kMixed) abandon();
    }
  }

  void abandon() {
    first_ = -1;
    num_green_ = 0;
  }

  // Ends a crossing before pixel `end`, if field follows that is darker than it.
  void close(int end) {
    if (end + kMargin + num_mixed_ >= length_) return;
    float after = 0;
    for (int i = end + num_mixed_; i < end + num_mixed_ + kMargin; ++i) {
      if (green_index(at(i)) < view_.threshold) return;
      after += whiteness(at(i)) / kMargin;
    }
    float peak = 0;
    for (int i = first_; i < end; ++i) peak = std::max(peak, whiteness(at(i)));
    const float base = std::max(level_, after);
    if (peak < base + contrast_) return;
    // Centroid of the brightness above the field.
    float sum = 0;
    float moment = 0;
    // One pixel more on both sides, for subpixel precision.
    for (int i = std::max(0, first_ - 1); i <= std::min(end, length_ - 1); ++i) {
      const float weight = std::max(0.0f, whiteness(at(i)) - base);
      sum += weight;
      moment += weight * static_cast<float>(i);
    }
    const auto point = [&](float i) {
      return cv::Point2f(static_cast<float>(start_.x) + i * static_cast<float>(step_.x),
                         static_cast<float>(start_.y) + i * static_cast<float>(step_.y));
    };
    const LinePoint found{point(moment / sum), point(static_cast<float>(first_) - 0.5f),
                          point(static_cast<float>(end) - 0.5f)};
    if (view_.is_inside(found.pixel.x, found.pixel.y)) points_.push_back(found);
  }

  const FieldView& view_;
  float contrast_;
  float index_fraction_;
  float drop_;
  cv::Point start_;
  cv::Point step_;
  /** The first pixel, and the distance between two, bytes. */
  const uint8_t* pixels_;
  std::ptrdiff_t pixel_step_;
  int length_;
  std::vector<LinePoint>& points_;
  /** Mean whiteness and green index of the field before this pixel. */
  float level_ = 0;
  float level_index_ = 0;
  int num_green_ = 0;
  /** Beginning of the crossing; -1 outside of one. */
  int first_ = -1;
  int num_mixed_ = 0;
  /** Pixels like field since the last one of the line. */
  int num_end_ = 0;
  /** Greatest whiteness of the crossing. */
  float peak_ = 0;
};

}  // namespace

// Horizontal scan lines find lines that lead away from the robot, vertical ones those across.
std::vector<LinePoint> find_line_points(const FieldView& view,
                                        const VisionParameters::LinePoints& parameters) {
  std::vector<LinePoint> points;
  const int width = view.smooth.cols;
  const int height = view.smooth.rows;
  for (int y = kScanSpacing / 2; y < height; y += kScanSpacing) {
    Scan(view, parameters, {0, y}, {1, 0}, width, points).run();
  }
  for (int x = kScanSpacing / 2; x < width; x += kScanSpacing) {
    // From a little above the field's border downwards.
    const int top = std::max(0, 2 * view.top[std::min(x / 2, view.other.cols - 1)] - kScanSpacing);
    if (top < height) Scan(view, parameters, {x, top}, {0, 1}, height - top, points).run();
  }
  return points;
}

}  // namespace nao::vision
