#include "daemons/vision/line_continuation.h"

#include <algorithm>
#include <cmath>

namespace nao::vision {
namespace {

/** Largest gap between neighboring points, pixels: three scan lines. */
constexpr float kContinuationGap = 28;
/** Farthest point of one continuation, pixels. Chosen: a bend of the center circle turns by less
 * than the greatest turn within it. */
constexpr float kContinuationReach = 60;
/** Shortest continuation, pixels: two scan lines. */
constexpr float kLeastContinuedLength = 12;
constexpr int kLeastContinuedPoints = 3;
/** Segments of fewer points are weak evidence. */
constexpr int kStrongPoints = 8;
/** Cosine of the greatest turn at an end: 40 degrees, so that a crossing line is not mistaken for
 * the continuation. */
constexpr float kLeastCosine = 0.766f;
/** Points this near to the line belong to it, pixels; wider lines have noisier points. */
constexpr float kContinuationTolerance = 1.6f;
constexpr float kContinuationToleranceOfWidth = 0.08f;
/** Greatest ratio of a point's width to the segment's. */
constexpr float kWidthRatio = 1.8f;
/** Thin lines' widths are whole pixels. */
constexpr float kWidthStep = 1.5f;
/** Most continuations of one end. */
constexpr int kMostSteps = 8;

/** An end of a segment. */
struct End {
  cv::Point2f place;
  /** Unit vector away from the segment. */
  cv::Point2f direction;
  float width = 0;
};

class Continuation {
 public:
  Continuation(const std::vector<LinePoint>& points, const std::vector<cv::Point2f>& ideal)
      : points_(points), ideal_(ideal), is_used_(points.size(), 0) {}

  void follow(End end, std::vector<LineSegment>& found) {
    for (int step = 0; step < kMostSteps; ++step) {
      std::vector<int> run = best_run(end);
      if (run.size() < kLeastContinuedPoints) return;
      for (const int i : run) is_used_[i] = 1;
      const cv::Point2f last = ideal_[run.back()];
      const cv::Point2f direction = mean_direction(end.place, run);
      const cv::Point2f target = end.place + (last - end.place).dot(direction) * direction;
      found.push_back({end.place, target, static_cast<int>(run.size()), end.width});
      end = {target, direction, end.width};
    }
  }

 private:
  bool has_similar_width(int i, const End& end, const cv::Point2f& direction) const {
    const cv::Point2f d = points_[i].last - points_[i].first;
    const float width = std::abs(d.x * direction.y - d.y * direction.x);
    return width < kWidthRatio * end.width + kWidthStep &&
           end.width < kWidthRatio * width + kWidthStep;
  }

  /** Unused points ahead of the end, nearest first. */
  std::vector<std::pair<float, int>> ahead_of(const End& end) const {
    std::vector<std::pair<float, int>> ahead;
    for (size_t i = 0; i < ideal_.size(); ++i) {
      if (is_used_[i]) continue;
      const cv::Point2f d = ideal_[i] - end.place;
      if (std::abs(d.x) > kContinuationReach || std::abs(d.y) > kContinuationReach) continue;
      const auto distance = static_cast<float>(cv::norm(d));
      if (distance < 1 || distance > kContinuationReach ||
          d.dot(end.direction) < kLeastCosine * distance) {
        continue;
      }
      ahead.push_back({distance, static_cast<int>(i)});
    }
    std::sort(ahead.begin(), ahead.end());
    return ahead;
  }

  // Each point ahead gives a direction; the one with the most points near its ray is taken.
  std::vector<int> best_run(const End& end) const {
    const auto ahead = ahead_of(end);
    const float tolerance = kContinuationTolerance + kContinuationToleranceOfWidth * end.width;
    std::vector<int> best;
    for (const auto& [length, candidate] : ahead) {
      if (length < kLeastContinuedLength) continue;
      const cv::Point2f direction = (ideal_[candidate] - end.place) * (1 / length);
      std::vector<int> run;
      float last = 0;
      for (const auto& [distance, i] : ahead) {
        const cv::Point2f d = ideal_[i] - end.place;
        if (std::abs(d.x * direction.y - d.y * direction.x) > tolerance) continue;
        if (distance - last > kContinuationGap) break;
        if (!has_similar_width(i, end, direction)) continue;
        run.push_back(i);
        last = distance;
      }
      if (last >= kLeastContinuedLength && run.size() > best.size()) best = std::move(run);
    }
    return best;
  }

  cv::Point2f mean_direction(const cv::Point2f& from, const std::vector<int>& run) const {
    cv::Point2f sum(0, 0);
    for (const int i : run) sum += ideal_[i] - from;
    return sum * (1 / static_cast<float>(cv::norm(sum)));
  }

  const std::vector<LinePoint>& points_;
  const std::vector<cv::Point2f>& ideal_;
  std::vector<char> is_used_;
};

}  // namespace

std::vector<LineSegment> continue_segments(const std::vector<LineSegment>& segments,
                                           const std::vector<LinePoint>& points,
                                           const std::vector<cv::Point2f>& ideal) {
  Continuation continuation(points, ideal);
  std::vector<LineSegment> found;
  for (const LineSegment& segment : segments) {
    if (segment.num_points < kStrongPoints) continue;
    const cv::Point2f direction = (segment.to - segment.from) * (1 / segment.length());
    continuation.follow({segment.to, direction, segment.width}, found);
    continuation.follow({segment.from, -direction, segment.width}, found);
  }
  return found;
}

}  // namespace nao::vision
