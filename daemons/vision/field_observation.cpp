#include "daemons/vision/field_observation.h"

#include <algorithm>
#include <cmath>

#include "daemons/vision/ball_filter.h"

namespace nao::vision {
namespace {

/** The part of a line within a distance of the camera's ground point. */
std::optional<FieldLine> clipped(const FieldLine& line, const Eigen::Vector2d& center,
                                 double radius) {
  // |from + t (to - from) - center| = radius, a quadratic equation in t.
  const Eigen::Vector2d d = line.to - line.from;
  const Eigen::Vector2d f = line.from - center;
  const double a = d.squaredNorm();
  const double b = f.dot(d);
  const double c = f.squaredNorm() - radius * radius;
  const double root = b * b - a * c;
  if (a <= 0 || root <= 0) return std::nullopt;
  const double first = std::max(0.0, (-b - std::sqrt(root)) / a);
  const double last = std::min(1.0, (-b + std::sqrt(root)) / a);
  if (last <= first) return std::nullopt;
  return FieldLine{line.from + first * d, line.from + last * d};
}

}  // namespace

double FieldObservation::length() const {
  double sum = 0;
  for (const FieldLine& line : lines) sum += (line.to - line.from).norm();
  return sum;
}

Eigen::Matrix2d FieldObservation::tilt_jacobian(const Eigen::Vector2d& point) const {
  return vision::tilt_jacobian(camera, point) * Eigen::Rotation2Dd(seen_heading);
}

FieldObservation FieldObservation::tilted(const Eigen::Vector2d& tilt) const {
  FieldObservation result = *this;
  const auto move = [&](Eigen::Vector2d& point) { point += tilt_jacobian(point) * tilt; };
  for (FieldLine& line : result.lines) {
    move(line.from);
    move(line.to);
  }
  if (result.circle) move(*result.circle);
  for (Eigen::Vector2d& post : result.posts) move(post);
  return result;
}

FieldObservation FieldObservation::moved_to(const Pose2& target) const {
  const Pose2 move = target.inverse() * heading_in_odometry;
  FieldObservation moved = *this;
  moved.heading_in_odometry = target;
  moved.seen_heading = seen_heading + move.heading;
  const Eigen::Vector2d camera_ground = move * Eigen::Vector2d(camera.position.head<2>());
  moved.camera.position.head<2>() = camera_ground;
  for (FieldLine& line : moved.lines) line = {move * line.from, move * line.to};
  if (circle) moved.circle = move * *circle;
  for (Eigen::Vector2d& post : moved.posts) post = move * post;
  return moved;
}

FieldObservation observe_field(const Detections& detections, const CameraPlace& camera,
                               const Pose2& heading_in_odometry,
                               const VisionParameters::FieldObservation& parameters) {
  FieldObservation observation;
  observation.heading_in_odometry = heading_in_odometry;
  observation.camera = camera;
  const Eigen::Vector2d center = camera.position.head<2>();
  for (const Detection& detection : detections) {
    if (!detection.has_position()) continue;
    const double distance = (detection.position - center).norm();
    if (detection.kind == Kind::kLine && detection.end.allFinite()) {
      const auto line = clipped({detection.position, detection.end}, center, parameters.reach);
      if (line && (line->to - line->from).norm() >= parameters.least_length) {
        observation.lines.push_back(*line);
      }
    } else if (detection.kind == Kind::kCenterCircle && distance < parameters.reach) {
      observation.circle = detection.position;
    } else if (detection.kind == Kind::kGoalPost && distance < parameters.post_reach) {
      observation.posts.push_back(detection.position);
    }
  }
  return observation;
}

Eigen::Matrix2d tilt_jacobian(const CameraPlace& camera, const Eigen::Vector2d& point) {
  const Eigen::Vector2d P = point - camera.position.head<2>();
  const double h = camera.position.z();
  Eigen::Matrix2d jacobian;
  jacobian << P.x() * P.y() / h, -h - P.x() * P.x() / h,  //
      h + P.y() * P.y() / h, -P.x() * P.y() / h;
  return jacobian;
}

void correct_by_tilt(const CameraPlace& camera, const Eigen::Vector2d& tilt,
                     Detections& detections) {
  for (Detection& detection : detections) {
    if (!detection.has_position()) continue;
    CameraPlace above = camera;
    if (detection.kind == Kind::kBall) {
      // The observed point is its center.
      above.position.z() -= kBallRadius;
    } else if (detection.kind != Kind::kRobot) {
      continue;
    }
    detection.position += tilt_jacobian(above, detection.position) * tilt;
  }
}

}  // namespace nao::vision
