#include "daemons/vision/line_detector.h"

#include <algorithm>
#include <cmath>

#include "common/random.h"

namespace nao::vision {
namespace {

/** Samples of one segment. Chosen: more find no further segments in rendered images. */
constexpr int kNumSamples = 400;
/** Distance of the two points of a sample, pixels. */
constexpr float kLeastBase = 12;
constexpr float kMostBase = 140;
/** Largest gap between neighboring points of a segment, pixels: three scan lines. */
constexpr int kLeastLinePoints = 5;
/** Least fraction of the scan lines across a segment that found it: few unrelated points lie in a
 * row. Tuned on real and rendered images: 0.7 loses blurred lines, less keeps more false ones. */
constexpr int kMostSegments = 24;

struct Line {
  cv::Point2f origin;
  cv::Point2f direction;

  float along(const cv::Point2f& p) const { return (p - origin).dot(direction); }
  float distance(const cv::Point2f& p) const {
    const cv::Point2f d = p - origin;
    return std::abs(d.x * direction.y - d.y * direction.x);
  }
};

/** Distance from a line within which each point belongs to it, pixels. */
std::vector<float> tolerances_of(const std::vector<LinePoint>& points,
                                 const VisionParameters::LineDetector& parameters) {
  const auto least = static_cast<float>(parameters.tolerance);
  const auto of_width = static_cast<float>(parameters.tolerance_of_width);
  std::vector<float> tolerances;
  tolerances.reserve(points.size());
  for (const LinePoint& point : points) {
    const auto extent = static_cast<float>(cv::norm(point.last - point.first));
    tolerances.push_back(least + of_width * std::min(extent, 40.0f));
  }
  return tolerances;
}

/** Indices of the longest run of inliers without a gap, in order along the line.
 * @param least_count  Nothing is returned if there are fewer inliers: most samples of RANSAC. */
// Inliers of a line, sorted along it; the longest stretch without a gap is one segment.
std::vector<int> longest_run(const Line& line, const std::vector<cv::Point2f>& ideal,
                             const std::vector<float>& tolerances, float largest_gap,
                             size_t least_count) {
  size_t count = 0;
  for (size_t i = 0; i < ideal.size(); ++i) count += line.distance(ideal[i]) <= tolerances[i];
  if (count < least_count) return {};
  std::vector<std::pair<float, int>> inliers;
  inliers.reserve(count);
  for (size_t i = 0; i < ideal.size(); ++i) {
    if (line.distance(ideal[i]) > tolerances[i]) continue;
    inliers.push_back({line.along(ideal[i]), static_cast<int>(i)});
  }
  std::sort(inliers.begin(), inliers.end());
  size_t best_first = 0;
  size_t best_count = 0;
  size_t first = 0;
  for (size_t i = 0; i < inliers.size(); ++i) {
    if (i > 0 && inliers[i].first - inliers[i - 1].first > largest_gap) first = i;
    if (i + 1 - first > best_count) {
      best_count = i + 1 - first;
      best_first = first;
    }
  }
  std::vector<int> run;
  for (size_t i = best_first; i < best_first + best_count; ++i) run.push_back(inliers[i].second);
  return run;
}

/** Total least squares: the direction of the greatest variance, which is the scatter matrix's
 * eigenvector of the larger eigenvalue. In closed form: angle = atan2(2 xy, xx - yy) / 2. */
Line fit(const std::vector<int>& run, const std::vector<cv::Point2f>& ideal) {
  cv::Point2f mean(0, 0);
  for (const int i : run) mean += ideal[i] * (1.0f / static_cast<float>(run.size()));
  float xx = 0;
  float xy = 0;
  float yy = 0;
  for (const int i : run) {
    const cv::Point2f d = ideal[i] - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const float angle = 0.5f * std::atan2(2 * xy, xx - yy);
  return {mean, {std::cos(angle), std::sin(angle)}};
}

/** Median width across the line: a scan line at an angle sees it longer. */
// Across the line, so that scan lines in both directions give the same width.
float median_width(const std::vector<int>& run, const Line& line,
                   const std::vector<LinePoint>& points) {
  std::vector<float> widths;
  for (const int i : run) {
    const cv::Point2f d = points[i].last - points[i].first;
    widths.push_back(std::abs(d.x * line.direction.y - d.y * line.direction.x));
  }
  std::nth_element(widths.begin(), widths.begin() + widths.size() / 2, widths.end());
  return widths[widths.size() / 2];
}

/** Whether the width fits a field line, if that is known. */
bool has_fitting_width(const LineSegment& segment, const Line& line, const CameraGeometry& geometry,
                       const VisionParameters::LineDetector& parameters) {
  // A segment must be longer than it is wide.
  if (segment.length() < 1.3f * segment.width) return false;
  const cv::Point2f middle = 0.5f * (segment.from + segment.to);
  const cv::Point2f across(-line.direction.y, line.direction.x);
  // Width on the ground: the step across the segment, without its part along the line.
  const auto a = geometry.at_height(middle - 0.5f * segment.width * across, 0);
  const auto b = geometry.at_height(middle + 0.5f * segment.width * across, 0);
  if (!geometry.has_pose()) return true;
  if (!a || !b) return false;
  const auto c = geometry.at_height(middle + 2.0f * line.direction, 0);
  const auto d = geometry.at_height(middle - 2.0f * line.direction, 0);
  if (!c || !d) return false;
  const Eigen::Vector2d along = (*c - *d).normalized();
  const Eigen::Vector2d step = *b - *a;
  const double width = std::abs(step.x() * along.y() - step.y() * along.x());
  // One pixel may be more than a line's width far away.
  const double pixel = width / std::max(1.0f, segment.width);
  return width > parameters.least_ground_width - pixel &&
         width < parameters.most_ground_width + 2 * pixel;
}

/** Most of the scan lines that it crosses found it. */
bool is_dense(const LineSegment& segment, double least_density) {
  const cv::Point2f d = segment.to - segment.from;
  const float crossed = std::max(std::abs(d.x), std::abs(d.y)) / kScanSpacing;
  return static_cast<float>(segment.num_points) >= static_cast<float>(least_density) * crossed;
}

}  // namespace

std::vector<LineSegment> LineDetector::detect(std::vector<LinePoint>& points,
                                              std::vector<cv::Point2f>& ideal,
                                              const CameraGeometry& geometry) const {
  std::vector<LineSegment> segments;
  std::vector<LinePoint> rejected;
  std::vector<cv::Point2f> rejected_ideal;
  std::vector<float> tolerances = tolerances_of(points, parameters_);
  const auto largest_gap = static_cast<float>(parameters_.largest_gap);
  // Sequential RANSAC with a fixed seed: one segment in each round, whose points are then removed.
  Random random(1);
  for (int round = 0; round < kMostSegments && points.size() >= kLeastLinePoints; ++round) {
    std::vector<int> best;
    for (int sample = 0; sample < kNumSamples; ++sample) {
      const size_t i = random.next() % ideal.size();
      const size_t j = random.next() % ideal.size();
      const cv::Point2f step = ideal[j] - ideal[i];
      const auto base = static_cast<float>(cv::norm(step));
      // Two near points give no direction, and two distant ones rarely belong to one line.
      if (base < kLeastBase || base > kMostBase) continue;
      std::vector<int> run = longest_run({ideal[i], step * (1 / base)}, ideal, tolerances,
                                         largest_gap, best.size() + 1);
      if (run.size() > best.size()) best = std::move(run);
    }
    if (best.size() < kLeastLinePoints) break;
    const Line line = fit(best, ideal);
    // The inliers of the fitted line are kept only if no points were lost.
    std::vector<int> run = longest_run(line, ideal, tolerances, largest_gap, best.size());
    if (run.size() < best.size()) run = best;
    const float first = line.along(ideal[run.front()]);
    const float last = line.along(ideal[run.back()]);
    LineSegment segment{line.origin + std::min(first, last) * line.direction,
                        line.origin + std::max(first, last) * line.direction,
                        static_cast<int>(run.size()), median_width(run, line, points)};
    const bool is_accepted = segment.length() >= parameters_.least_length &&
                             is_dense(segment, parameters_.least_density) &&
                             has_fitting_width(segment, line, geometry, parameters_);
    if (is_accepted) segments.push_back(segment);
    // They are removed even if the segment was rejected, since the next round must find another.
    // Such points may still continue another segment.
    std::sort(run.begin(), run.end(), std::greater<>());
    for (const int i : run) {
      if (!is_accepted) {
        rejected.push_back(points[i]);
        rejected_ideal.push_back(ideal[i]);
      }
      points.erase(points.begin() + i);
      tolerances.erase(tolerances.begin() + i);
      ideal.erase(ideal.begin() + i);
    }
  }
  points.insert(points.end(), rejected.begin(), rejected.end());
  ideal.insert(ideal.end(), rejected_ideal.begin(), rejected_ideal.end());
  return segments;
}

Detection line_detection(const LineSegment& segment, const CameraGeometry& geometry) {
  Detection detection;
  detection.kind = Kind::kLine;
  const cv::Point2f a = geometry.distorted(segment.from);
  const cv::Point2f b = geometry.distorted(segment.to);
  detection.line_px = {a.x, a.y, b.x, b.y};
  const double margin = 0.5 * segment.width;
  detection.box_px = {std::min(a.x, b.x) - margin, std::min(a.y, b.y) - margin,
                      std::max(a.x, b.x) + margin, std::max(a.y, b.y) + margin};
  const auto from = geometry.locate(segment.from);
  const auto to = geometry.locate(segment.to);
  if (from && to) {
    detection.position = from->position;
    detection.covariance = from->covariance;
    detection.end = to->position;
  }
  // A segment of 20 points is certain; chosen.
  detection.confidence = std::min(1.0, 0.3 + 0.7 * segment.num_points / 20.0);
  return detection;
}

}  // namespace nao::vision
