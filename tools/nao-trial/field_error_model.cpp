#include "tools/nao-trial/field_error_model.h"

#include <cmath>

#include "tools/nao-trial/visible_field.h"

namespace nao::trial {
namespace {

using vision::CameraGeometry;
using vision::Detection;
using vision::Detections;
using vision::FieldLine;
using vision::Kind;

/** All of these are fitted to `nao-trial localise --disturbances moderate --seeds 1-2 --duration
 * 200`, whose statistics of detections localise-error-model repeats (docs/vision.md).
 *
 * Probabilities that a visible piece of a line is found, by its distance in m; false lines for
 * each piece; of the circle; and of lines on each arc of it. */
constexpr double kFoundNear = 0.92;
constexpr double kFoundFar = 0.78;
constexpr double kFoundFarther = 0.91;
constexpr double kFalse = 0.055;
constexpr double kCircleNear = 0.79;
constexpr double kCircleFar = 0.63;
constexpr double kArc = 0.91;
/** Length of such an arc, and from one to the next, in steps of 1/72 of the circle. */
constexpr size_t kArcSteps = 6;
constexpr size_t kArcPeriod = 16;
/** Greatest missing fraction of a piece at an end: for most ends, and for a fraction of them. */
constexpr double kMostMissing = 0.02;
constexpr double kWorseMissing = 0.43;
constexpr double kWorseMissingFraction = 0.2;
/** Standard deviation of an end in each direction, pixels: for most, and for a fraction of them. */
constexpr double kPixelSigma = 0.13;
constexpr double kWorsePixelSigma = 1.1;
constexpr double kWorseFraction = 0.2;
/** Shortest line that is found, pixels, as LineDetector. */
constexpr float kLeastPixels = 26;
/** Standard deviation of the circle's center, m: for most, and for a fraction of them. */
constexpr double kCircleSigma = 0.025;
constexpr double kWorseCircleSigma = 0.18;
constexpr double kWorseCircleFraction = 0.25;

}  // namespace

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
  detection.line_px = {from.x, from.y, to.x, to.y};
  detection.confidence = 0.8;
  detections.push_back(detection);
}

void FieldErrorModel::add_piece(const std::vector<cv::Point2f>& piece, const CameraGeometry& truth,
                                const CameraGeometry& estimated, Detections& detections) {
  const auto middle = truth.at_height(piece[piece.size() / 2], 0);
  const double range = middle ? middle->norm() : 1e9;
  const double found = range < kNearRange  ? kFoundNear
                       : range < kFarRange ? kFoundFar
                                           : kFoundFarther;
  const auto missing = [&] {
    const bool is_worse = random_.uniform() < kWorseMissingFraction;
    return random_.uniform(0, is_worse ? kWorseMissing : kMostMissing);
  };
  const double first = missing();
  const double last = 1 - missing();
  const auto end = [&](double fraction) {
    const auto index = static_cast<size_t>(fraction * static_cast<double>(piece.size() - 1));
    const double sigma = random_.uniform() < kWorseFraction ? kWorsePixelSigma : kPixelSigma;
    return piece[index] + cv::Point2f(static_cast<float>(sigma * random_.normal()),
                                      static_cast<float>(sigma * random_.normal()));
  };
  const cv::Point2f from = end(first);
  const cv::Point2f to = end(last);
  if (random_.uniform() < found) add_line(from, to, estimated, detections);
  if (random_.uniform() >= kFalse) return;
  const cv::Point2f place(static_cast<float>(random_.uniform(0, width_)),
                          static_cast<float>(random_.uniform(0.4, 1) * height_));
  const double angle = random_.uniform(0, M_PI);
  const double length = random_.uniform(30, 150);
  add_line(place,
           place + cv::Point2f(static_cast<float>(length * std::cos(angle)),
                               static_cast<float>(length * std::sin(angle))),
           estimated, detections);
}

void FieldErrorModel::add_circle(const Eigen::Isometry3d& true_pose, const CameraGeometry& truth,
                                 const Eigen::Isometry3d& estimated_pose,
                                 const CameraGeometry& estimated, Detections& detections) {
  const std::vector<cv::Point2f> visible = VisibleField(field_, truth, width_, height_).circle();
  // Some of its bends become lines. The straight line with the least squares of its distances from
  // an arc with the sagitta s lies 2/3 s from the chord.
  for (size_t i = 0; i + kArcSteps < visible.size(); i += kArcPeriod) {
    if (random_.uniform() >= kArc) continue;
    const cv::Point2f& from = visible[i];
    const cv::Point2f& to = visible[i + kArcSteps];
    const cv::Point2f shift = (visible[i + kArcSteps / 2] - 0.5f * (from + to)) * (2.0f / 3);
    add_line(from + shift, to + shift, estimated, detections);
  }
  if (visible.size() < kNumCirclePoints / 3) return;
  const double range = true_pose.translation().head<2>().norm();
  const double found = range < kNearRange ? kCircleNear : range < kFarRange ? kCircleFar : 0;
  if (random_.uniform() >= found) return;
  const auto center = find_seen_center(visible, calibration_, true_pose, estimated_pose);
  if (!center) return;
  const double sigma = random_.uniform() < kWorseCircleFraction ? kWorseCircleSigma : kCircleSigma;
  Detection circle;
  circle.kind = Kind::kCenterCircle;
  circle.position = *center + sigma * Eigen::Vector2d(random_.normal(), random_.normal());
  circle.covariance = Eigen::Matrix2d::Identity() * sigma * sigma;
  circle.confidence = 0.8;
  detections.push_back(circle);
}

Detections FieldErrorModel::detect(const Eigen::Isometry3d& true_pose,
                                   const Eigen::Isometry3d& estimated_pose) {
  const CameraGeometry truth(calibration_, true_pose);
  const CameraGeometry estimated(calibration_, estimated_pose);
  const VisibleField visible(field_, truth, width_, height_);
  Detections detections;
  for (const FieldLine& line : field_.lines()) {
    for (const std::vector<cv::Point2f>& piece : visible.pieces(line)) {
      add_piece(piece, truth, estimated, detections);
    }
  }
  add_circle(true_pose, truth, estimated_pose, estimated, detections);
  return detections;
}

}  // namespace nao::trial
