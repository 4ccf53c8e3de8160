#include <algorithm>
#include <cmath>

#include "daemons/vision/landmarks.h"

namespace nao::vision {
namespace {

struct Meeting {
  /** Pixels beyond the nearer end (positive) or inside of it (negative). */
  float beyond = 0;
  float limit = 0;
  float inside = 0;
  bool is_reached() const { return beyond < limit; }
  bool is_end() const { return beyond > -inside; }
};

// Where the crossing lies relative to the ends of one of the two segments.
Meeting meeting_of(const LineSegment& segment, const cv::Point2f& point, float other_width,
                   const VisionParameters::CrossingDetector& parameters) {
  const cv::Point2f direction = (segment.to - segment.from) * (1 / segment.length());
  const float along = (point - segment.from).dot(direction);
  const float width =
      static_cast<float>(parameters.reach_in_widths) * std::max(other_width, segment.width);
  return {std::max(-along, along - segment.length()),
          std::max(static_cast<float>(parameters.reach), width),
          std::max(static_cast<float>(parameters.inside), width)};
}

double ground_angle(const LineSegment& a, const LineSegment& b, const CameraGeometry& geometry) {
  // Angle between the lines on the ground, rad; 0 where the ground is not known, so that the pair
  // is rejected.
  const auto p = geometry.at_height(a.from, 0);
  const auto q = geometry.at_height(a.to, 0);
  const auto r = geometry.at_height(b.from, 0);
  const auto s = geometry.at_height(b.to, 0);
  if (!p || !q || !r || !s) return 0;
  const double cosine = std::abs((*q - *p).normalized().dot((*s - *r).normalized()));
  return std::acos(std::min(1.0, cosine));
}

}  // namespace

Detections CrossingDetector::detect(const std::vector<LineSegment>& segments, const FieldView& view,
                                    const CameraGeometry& geometry) const {
  Detections crossings;
  for (size_t i = 0; i < segments.size(); ++i) {
    for (size_t j = i + 1; j < segments.size(); ++j) {
      const LineSegment& a = segments[i];
      const LineSegment& b = segments[j];
      const cv::Point2f d = a.to - a.from;
      const cv::Point2f e = b.to - b.from;
      // Cross product of the directions: |d| |e| sin(angle).
      const float cross = d.x * e.y - d.y * e.x;
      if (std::abs(cross) < std::sin(parameters_.least_image_angle) * a.length() * b.length())
        continue;
      if (geometry.has_pose() && ground_angle(a, b, geometry) < parameters_.least_ground_angle)
        continue;
      const cv::Point2f f = b.from - a.from;
      // Intersection of both lines: a.from + t d with t = (f x e) / (d x e).
      const cv::Point2f point = a.from + d * ((f.x * e.y - f.y * e.x) / cross);
      const cv::Point2f pixel = geometry.distorted(point);
      if (pixel.x < 0 || pixel.y < 0 || pixel.x >= static_cast<float>(view.smooth.cols) ||
          pixel.y >= static_cast<float>(view.smooth.rows)) {
        continue;
      }
      const Meeting on_a = meeting_of(a, point, b.width, parameters_);
      const Meeting on_b = meeting_of(b, point, a.width, parameters_);
      if (!on_a.is_reached() || !on_b.is_reached()) continue;
      // Both lines end in an L, one of them in a T, none in an X.
      const int num_ends = (on_a.is_end() ? 1 : 0) + (on_b.is_end() ? 1 : 0);
      Detection detection;
      detection.kind = num_ends == 2   ? Kind::kCrossingL
                       : num_ends == 1 ? Kind::kCrossingT
                                       : Kind::kCrossingX;
      const double half = std::max({8.0f, a.width, b.width});
      detection.box_px = {pixel.x - half, pixel.y - half, pixel.x + half, pixel.y + half};
      if (const auto ground = geometry.locate(point)) {
        detection.position = ground->position;
        detection.covariance = ground->covariance;
      }
      detection.confidence = std::min(1.0, 0.4 + 0.03 * std::min(a.num_points, b.num_points));
      crossings.push_back(detection);
    }
  }
  return crossings;
}

}  // namespace nao::vision
