#include "tools/nao-trial/field_error_model.h"

#include <cmath>

namespace nao::trial {
namespace {

using vision::CameraGeometry;
using vision::Detection;
using vision::Detections;
using vision::FieldLine;
using vision::Kind;

/** Distance between the points of a line that are projected, m. */
constexpr double kStep = 0.05;
/** Probabilities that a visible piece of a line is found, by its distance in m; false lines for
 * each piece; of the circle. From docs/vision.md: recall on places that were not used for tuning.
 * False lines and the errors below: fitted to 231 true and 86 false lines and 9 circles in
 * `nao-vision-dataset FOLDER --images 120 --seed 5`, with the exact pose of the camera. */
constexpr double kNear = 3;
constexpr double kFar = 5;
constexpr double kFoundNear = 0.83;
constexpr double kFoundFar = 0.59;
constexpr double kFoundFarther = 0.3;
constexpr double kFalse = 0.25;
constexpr double kCircleNear = 0.9;
constexpr double kCircleFar = 0.4;
/** Part of a piece that is missing at each end, at most. */
constexpr double kMostMissing = 0.25;
/** Standard deviation of an end in each direction, pixels: of most, and of a fraction of them. */
constexpr double kPixelSigma = 0.35;
constexpr double kWorsePixelSigma = 1.7;
constexpr double kWorseFraction = 0.2;
/** Shortest line that is found, pixels, as LineDetector. */
constexpr float kLeastPixels = 26;
/** Of the circle's center, m, and for each m of its distance. */
constexpr double kCircleSigma = 0.003;
constexpr double kCircleSigmaPerDistance = 0.001;

}  // namespace

bool FieldErrorModel::is_in_image(const cv::Point2f& pixel) const {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < static_cast<float>(width_) &&
         pixel.y < static_cast<float>(height_);
}

void FieldErrorModel::add_line(const cv::Point2f& from, const cv::Point2f& to,
                               const CameraGeometry& estimated, Detections& detections) {
  if (cv::norm(to - from) < kLeastPixels) return;
  const auto a = estimated.locate(from);
  const auto b = estimated.locate(to);
  if (!a || !b) return;
  Detection detection;
  detection.kind = Kind::kLine;
  detection.position = a->position;
  detection.covariance = a->covariance;
  detection.end = b->position;
  detection.confidence = 0.8;
  detections.push_back(detection);
}

void FieldErrorModel::add_field_line(const FieldLine& line, const CameraGeometry& truth,
                                     const CameraGeometry& estimated, Detections& detections) {
  std::vector<cv::Point2f> piece;
  const auto finish = [&] {
    if (piece.size() >= 4) {
      const auto middle = truth.at_height(piece[piece.size() / 2], 0);
      const double range = middle ? middle->norm() : 1e9;
      const double found = range < kNear ? kFoundNear : range < kFar ? kFoundFar : kFoundFarther;
      const double first = random_.uniform(0, kMostMissing);
      const double last = 1 - random_.uniform(0, kMostMissing);
      const auto end = [&](double fraction) {
        const auto index = static_cast<size_t>(fraction * static_cast<double>(piece.size() - 1));
        const double sigma = random_.uniform() < kWorseFraction ? kWorsePixelSigma : kPixelSigma;
        return piece[index] + cv::Point2f(static_cast<float>(sigma * random_.normal()),
                                          static_cast<float>(sigma * random_.normal()));
      };
      const cv::Point2f from = end(first);
      const cv::Point2f to = end(last);
      if (random_.uniform() < found) add_line(from, to, estimated, detections);
      if (random_.uniform() < kFalse) {
        const cv::Point2f place(static_cast<float>(random_.uniform(0, width_)),
                                static_cast<float>(random_.uniform(0.4, 1) * height_));
        const double angle = random_.uniform(0, M_PI);
        const double length = random_.uniform(30, 150);
        add_line(place,
                 place + cv::Point2f(static_cast<float>(length * std::cos(angle)),
                                     static_cast<float>(length * std::sin(angle))),
                 estimated, detections);
      }
    }
    piece.clear();
  };
  const int num_steps = static_cast<int>(std::ceil((line.to - line.from).norm() / kStep));
  for (int i = 0; i <= num_steps; ++i) {
    const Eigen::Vector2d point = line.from + (line.to - line.from) * i / num_steps;
    const auto pixel = truth.project({point.x(), point.y(), 0});
    if (pixel && is_in_image(*pixel)) {
      piece.push_back(*pixel);
    } else {
      finish();
    }
  }
  finish();
}

void FieldErrorModel::add_circle(const Eigen::Isometry3d& true_pose, const CameraGeometry& truth,
                                 const Eigen::Isometry3d& estimated_pose,
                                 const CameraGeometry& estimated, Detections& detections) {
  constexpr int kNumPoints = 72;
  std::vector<cv::Point2f> visible;
  for (int i = 0; i < kNumPoints; ++i) {
    const double angle = 2 * M_PI * i / kNumPoints;
    const auto pixel = truth.project(
        {field_.circle_radius() * std::cos(angle), field_.circle_radius() * std::sin(angle), 0});
    if (pixel && is_in_image(*pixel)) visible.push_back(*pixel);
  }
  if (visible.size() < kNumPoints / 3) return;
  const double range = true_pose.translation().head<2>().norm();
  if (range > kFar || random_.uniform() > (range < kNear ? kCircleNear : kCircleFar)) {
    // Its bends become short lines.
    for (size_t i = 0; i + 8 < visible.size(); i += 16) {
      if (random_.uniform() < 0.5) add_line(visible[i], visible[i + 8], estimated, detections);
    }
    return;
  }
  // The center moves as the middle of the arc does when the camera's pose is wrong.
  const cv::Point2f middle = visible[visible.size() / 2];
  const auto seen = estimated.at_height(middle, 0);
  const auto arc = truth.at_height(middle, 0);
  if (!seen || !arc) return;
  const auto heading = [](const Eigen::Isometry3d& pose) {
    return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
  };
  const Eigen::Rotation2Dd turn(heading(estimated_pose) - heading(true_pose));
  const double sigma = kCircleSigma + kCircleSigmaPerDistance * range;
  Detection circle;
  circle.kind = Kind::kCenterCircle;
  circle.position = *seen + turn * Eigen::Vector2d(-*arc) +
                    sigma * Eigen::Vector2d(random_.normal(), random_.normal());
  circle.covariance = Eigen::Matrix2d::Identity() * sigma * sigma;
  circle.confidence = 0.8;
  detections.push_back(circle);
}

Detections FieldErrorModel::detect(const Eigen::Isometry3d& true_pose,
                                   const Eigen::Isometry3d& estimated_pose) {
  const CameraGeometry truth(calibration_, true_pose);
  const CameraGeometry estimated(calibration_, estimated_pose);
  Detections detections;
  for (const FieldLine& line : field_.lines()) {
    add_field_line(line, truth, estimated, detections);
  }
  add_circle(true_pose, truth, estimated_pose, estimated, detections);
  return detections;
}

}  // namespace nao::trial
