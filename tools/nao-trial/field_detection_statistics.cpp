#include "tools/nao-trial/field_detection_statistics.h"

#include <algorithm>
#include <cmath>

#include "tools/nao-trial/visible_field.h"

namespace nao::trial {
namespace {

using Eigen::Vector2d;
using vision::CameraGeometry;
using vision::Detection;
using vision::Detections;
using vision::Kind;

/** Shortest piece that counts, pixels, as LineDetector. */
constexpr double kLeastPiecePixels = 26;
/** A detected line with both ends this near to a field line, pixels, is that line. */
constexpr double kNearPixels = 8;
/** Farther ends of a line on the center circle, pixels: an arc is not straight. */
constexpr double kNearArcPixels = 12;

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  const auto index = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<size_t>(index)];
}

}  // namespace

std::vector<FieldDetectionStatistics::Piece> FieldDetectionStatistics::pieces_in(
    const CameraGeometry& truth) const {
  std::vector<Piece> pieces;
  const VisibleField visible(field_, truth, width_, height_);
  for (const vision::FieldLine& line : field_.lines()) {
    for (const std::vector<cv::Point2f>& points : visible.pieces(line)) {
      const auto middle = truth.at_height(points[points.size() / 2], 0);
      if (!middle || cv::norm(points.back() - points.front()) < kLeastPiecePixels) continue;
      Piece piece;
      piece.from = points.front();
      piece.to = points.back();
      piece.range = middle->norm();
      pieces.push_back(piece);
    }
  }
  return pieces;
}

bool FieldDetectionStatistics::is_arc(const Detection& line, const CameraGeometry& truth) const {
  const std::vector<cv::Point2f> circle = VisibleField(field_, truth, width_, height_).circle();
  const auto distance = [&](double x, double y) {
    double nearest = 1e9;
    for (const cv::Point2f& pixel : circle) {
      nearest = std::min(nearest, std::hypot(pixel.x - x, pixel.y - y));
    }
    return nearest;
  };
  return distance(line.line_px[0], line.line_px[1]) < kNearArcPixels &&
         distance(line.line_px[2], line.line_px[3]) < kNearArcPixels;
}

void FieldDetectionStatistics::add_line(const Detection& line, const CameraGeometry& truth,
                                        std::vector<Piece>& pieces) {
  const Vector2d ends[2] = {line.line_px.head<2>(), line.line_px.tail<2>()};
  Piece* best = nullptr;
  double best_distance = kNearPixels;
  double offsets[2] = {0, 0};
  double places[2] = {0, 0};
  for (Piece& piece : pieces) {
    const Vector2d from(piece.from.x, piece.from.y);
    const Vector2d step = Vector2d(piece.to.x, piece.to.y) - from;
    const double length = step.norm();
    const Vector2d along = step / length;
    double t[2];
    double offset[2];
    for (int i = 0; i < 2; ++i) {
      const Vector2d d = ends[i] - from;
      t[i] = d.dot(along) / length;
      offset[i] = d.x() * along.y() - d.y() * along.x();
    }
    const double distance = std::max(std::abs(offset[0]), std::abs(offset[1]));
    const bool overlaps = std::min(t[0], t[1]) < 1 && std::max(t[0], t[1]) > 0;
    if (!overlaps || distance > best_distance) continue;
    best = &piece;
    best_distance = distance;
    std::copy(t, t + 2, places);
    std::copy(offset, offset + 2, offsets);
  }
  if (best == nullptr) {
    if (is_arc(line, truth)) {
      ++num_arcs_;
    } else {
      ++num_false_;
    }
    return;
  }
  for (const double offset : offsets) pixel_errors_.push_back(std::abs(offset));
  const double first = std::clamp(std::min(places[0], places[1]), 0.0, 1.0);
  const double last = std::clamp(std::max(places[0], places[1]), 0.0, 1.0);
  best->first = std::min(best->first, first);
  best->last = std::max(best->last, last);
  best->covered += last - first;
}

void FieldDetectionStatistics::add_circle(const Detections& detections, const CameraGeometry& truth,
                                          const Eigen::Isometry3d& true_pose,
                                          const Eigen::Isometry3d& estimated_pose) {
  const std::vector<cv::Point2f> visible = VisibleField(field_, truth, width_, height_).circle();
  const double range = true_pose.translation().head<2>().norm();
  if (visible.size() < kNumCirclePoints / 3 || range > kFarRange) return;
  Count& count = circles_[range < kNearRange ? 0 : 1];
  ++count.all;
  const auto circle = std::find_if(detections.begin(), detections.end(), [](const Detection& d) {
    return d.kind == Kind::kCenterCircle;
  });
  if (circle == detections.end()) return;
  ++count.found;
  // The error of the camera's pose is left out.
  const auto center = find_seen_center(visible, calibration_, true_pose, estimated_pose);
  if (center) circle_errors_.push_back((circle->position - *center).norm());
}

void FieldDetectionStatistics::add(const Detections& detections, const Eigen::Isometry3d& true_pose,
                                   const Eigen::Isometry3d& estimated_pose,
                                   const Eigen::Vector3d& ball) {
  const CameraGeometry truth(calibration_, true_pose);
  std::vector<Piece> pieces = pieces_in(truth);
  ++num_images_;
  for (const Detection& detection : detections) {
    if (detection.kind == Kind::kLine) add_line(detection, truth, pieces);
    if (detection.kind != Kind::kBall || !detection.has_position()) continue;
    const double distance = (ball - true_pose.translation()).head<2>().norm();
    // A detection farther away or elsewhere is of another object.
    const auto pixel = truth.project(ball);
    if (distance > kNearRange || !pixel) continue;
    const Eigen::Vector4d& box = detection.box_px;
    if (std::hypot(0.5 * (box[0] + box[2]) - pixel->x, 0.5 * (box[1] + box[3]) - pixel->y) > 20) {
      continue;
    }
    const double seen = (detection.position - estimated_pose.translation().head<2>()).norm();
    ball_errors_.push_back(100 * std::abs(seen - distance) / distance);
  }
  for (const Piece& piece : pieces) {
    Count& count = lines_[piece.range < kNearRange ? 0 : piece.range < kFarRange ? 1 : 2];
    ++count.all;
    if (piece.covered <= 0) continue;
    ++count.found;
    missing_.push_back(1 - std::min(1.0, piece.covered));
  }
  add_circle(detections, truth, true_pose, estimated_pose);
}

std::vector<std::pair<std::string, double>> FieldDetectionStatistics::metrics() const {
  const double images = std::max(1, num_images_);
  std::vector<std::pair<std::string, double>> result{
      {"lines_found_to_3m", lines_[0].fraction()},
      {"lines_found_3_to_5m", lines_[1].fraction()},
      {"lines_found_beyond", lines_[2].fraction()},
      {"line_missing_median", quantile(missing_, 0.5)},
      {"line_missing_p90", quantile(missing_, 0.9)},
      {"line_end_median_px", quantile(pixel_errors_, 0.5)},
      {"line_end_p90_px", quantile(pixel_errors_, 0.9)},
      {"arcs_per_image", num_arcs_ / images},
      {"false_lines_per_image", num_false_ / images},
      {"circles_found_to_3m", circles_[0].fraction()},
      {"circles_found_3_to_5m", circles_[1].fraction()},
      {"circle_error_median_m", quantile(circle_errors_, 0.5)},
      {"circle_error_p90_m", quantile(circle_errors_, 0.9)}};
  for (const double error : ball_errors_) result.emplace_back("ball_distance_error_percent", error);
  return result;
}

std::vector<std::pair<std::string, std::string>> FieldDetectionStatistics::units() {
  return {{"line_end_median_px", "pixels"},
          {"line_end_p90_px", "pixels"},
          {"circle_error_median_m", "m"},
          {"circle_error_p90_m", "m"},
          {"ball_distance_error_percent", "%"}};
}

}  // namespace nao::trial
