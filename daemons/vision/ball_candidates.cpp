#include "daemons/vision/ball_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nao::vision {
namespace {

/** Most hints of one image; with a pose, by which the size of a ball is known, fewer are enough.
 * Chosen: each costs 0.04 ms to judge. */
constexpr size_t kMostHints = 24;
constexpr size_t kMostHintsWithPose = 14;
/** Without a pose, this many of each radius at least: lines have many places that are as bright as
 * a small ball on the field, and brighter than a large one on a line. */
constexpr size_t kMostOfRadius = 2;
/** Radii that are tried without a pose, pixels of the half-size image: each 1.4 times the last. */
constexpr std::array<float, 9> kRadii = {2.5f, 3.5f, 5, 7, 10, 14, 20, 28, 38};
/** Smallest radius, pixels of the half-size image: a ball at 5 m has a radius of 3. */
constexpr float kLeastRadius = 1.8f;
/** Half the width of the box inside of a ball, radii. */
constexpr float kInner = 0.65f;
/** Weight of the side that looks least like field. */
constexpr float kTouching = 0.4f;
/** Levels of FieldView::other_or_yellow: least mean of the box inside, least score. Chosen low,
 * since the network rejects what is not a ball. */
constexpr int kInside = 60;
constexpr float kLeastScore = 45;
/** Distance between columns for which the expected radius is computed, pixels of the half-size
 * image. */
constexpr int kColumns = 40;

struct BallHint {
  Circle circle;
  /** Mean of FieldView::other_or_yellow inside less that outside. */
  float score = 0;
  /** Number of the radius in kRadii; 0 with a pose. */
  size_t number = 0;
};

/** The nearest integer from 0 to a limit. std::lround takes a call for each; the sum is exact for
 * pixels. */
int round_within(float value, int limit) {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings)
  return std::min(static_cast<int>(std::max(value, 0.0f) + 0.5f), limit);
}

// Tests places of the half-size image by means over boxes; the integral image gives each mean with
// four look-ups, whatever its size.
class Search {
 public:
  explicit Search(const FieldView& view) : view_(view) {
    cv::integral(view.other_or_yellow, sum_, CV_32S);
  }

  /** Tests places x = first, first + step, ... below `end` of row y, in columns whose field begins
   * at most in row `lowest_top`. */
  void add_row(int y, float r, int first, int end, int step, int lowest_top, size_t number = 0) {
    // Most places are rejected by the box inside, whose rows are the same for all of them.
    const auto fy = static_cast<float>(y);
    const int y0 = round_within(fy - kInner * r, view_.other.rows);
    const int y1 = round_within(fy + kInner * r + 1, view_.other.rows);
    const int* above = sum_[y0];
    const int* below = sum_[y1];
    for (int x = first; x < end; x += step) {
      if (view_.top[x] > lowest_top) continue;
      const auto fx = static_cast<float>(x);
      const int x0 = round_within(fx - kInner * r, view_.other.cols);
      const int x1 = round_within(fx + kInner * r + 1, view_.other.cols);
      const int sum = below[x1] - above[x1] - below[x0] + above[x0];
      if (sum >= kInside * (x1 - x0) * (y1 - y0)) add(x, y, r, number);
    }
  }

  /** Keeps the best ones; among overlapping ones of similar size, only the best.
   * @param most_of_radius  The best of each radius come first, so many. */
  std::vector<Circle> best(size_t most, size_t most_of_radius) {
    std::sort(hints_.begin(), hints_.end(),
              [](const BallHint& a, const BallHint& b) { return a.score > b.score; });
    std::vector<Circle> kept;
    std::array<size_t, kRadii.size()> counts{};
    for (const size_t limit : {most_of_radius, most}) {
      for (const BallHint& hint : hints_) {
        if (kept.size() == most) return kept;
        if (counts[hint.number] >= limit) continue;
        // Non-maximum suppression, best first.
        const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Circle& b) {
          const Circle& a = hint.circle;
          const float ratio = a.radius / b.radius;
          return ratio > 0.6f && ratio < 1.7f &&
                 cv::norm(a.center - b.center) < std::max(a.radius, b.radius);
        });
        if (!is_new) continue;
        kept.push_back(hint.circle);
        ++counts[hint.number];
      }
    }
    return kept;
  }

 private:
  void add(int x, int y, float r, size_t number) {
    const auto fx = static_cast<float>(x);
    const auto fy = static_cast<float>(y);
    const float inside = mean(fx - kInner * r, fy - kInner * r, fx + kInner * r, fy + kInner * r);
    // The boxes are left, right and below; above, there may be anything, such as a goal behind the
    // field.
    std::array<float, 3> sides = {
        mean(fx - 1.9f * r - 1, fy - 0.5f * r, fx - 1.3f * r - 0.5f, fy + 0.5f * r),
        mean(fx + 1.3f * r + 0.5f, fy - 0.5f * r, fx + 1.9f * r + 1, fy + 0.5f * r),
        mean(fx - 0.5f * r, fy + 1.25f * r + 0.5f, fx + 0.5f * r, fy + 1.8f * r + 1)};
    std::sort(sides.begin(), sides.end());
    // A line or another robot may touch the ball on one side.
    const float score = inside - (sides[0] + sides[1] + kTouching * sides[2]) / (2 + kTouching);
    if (score < kLeastScore) return;
    // From pixels of the half-size image to pixels of the full one: centers are half a pixel off.
    hints_.push_back({{{2 * fx + 0.5f, 2 * fy + 0.5f}, 2 * r}, score, number});
  }

  /** Mean over a box, the part in the image; what is outside of it counts as field. */
  float mean(float left, float top, float right, float bottom) const {
    const int x0 = round_within(left, view_.other.cols);
    const int x1 = round_within(right + 1, view_.other.cols);
    const int y0 = round_within(top, view_.other.rows);
    const int y1 = round_within(bottom + 1, view_.other.rows);
    const int area = (x1 - x0) * (y1 - y0);
    if (area <= 0) return 0;
    const int sum = sum_(y1, x1) - sum_(y0, x1) - sum_(y1, x0) + sum_(y0, x0);
    return static_cast<float>(sum) / static_cast<float>(area);
  }

  const FieldView& view_;
  cv::Mat_<int> sum_;
  std::vector<BallHint> hints_;
};

}  // namespace

std::vector<Circle> find_ball_hints(const FieldView& view, const CameraGeometry& geometry,
                                    double ball_radius) {
  Search search(view);
  const int width = view.other.cols;
  const int height = view.other.rows;
  // Without a pose every radius is tried everywhere: slower, with more false hints.
  if (!geometry.has_pose()) {
    for (size_t number = 0; number < kRadii.size(); ++number) {
      const float r = kRadii[number];
      const int step = std::max(2, static_cast<int>(0.35f * r));
      for (int y = 0; y < height + static_cast<int>(0.4f * r); y += step) {
        search.add_row(y, r, 0, width, step, y, number);
      }
    }
    return search.best(kMostHints, kMostOfRadius);
  }
  // With a pose the radius at a place is known: computed every few rows and in the middle of a
  // strip of columns, since it changes slowly across the image.
  for (int left = 0; left < width; left += kColumns) {
    const int middle = left + kColumns / 2;
    float r = 0;
    int computed = -100;
    for (int y = 0; y < height + height / 12; y += std::max(1, static_cast<int>(0.25f * r))) {
      // Skip rows above the field's border, with room for a border that is higher elsewhere in the
      // strip.
      if (view.top[std::min(middle, width - 1)] > y + 3 * kColumns) continue;
      if (y - computed >= 4) {
        const cv::Point2f pixel(2 * static_cast<float>(middle), 2 * static_cast<float>(y));
        const auto radius = geometry.sphere_radius_px(pixel, ball_radius);
        r = radius ? static_cast<float>(*radius / 2) : 0;
        computed = y;
      }
      if (r < kLeastRadius || r > static_cast<float>(height)) continue;
      const int step = std::max(1, static_cast<int>(0.25f * r));
      search.add_row(y, r, left, std::min(left + kColumns, width), step,
                     y + static_cast<int>(0.8f * r));
    }
  }
  return search.best(kMostHintsWithPose, 0);
}

}  // namespace nao::vision
