#include "daemons/vision/pose_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace nao::vision {
namespace {

double square(double x) {
  return x * x;
}

const Eigen::Matrix2d kQuarterTurn = (Eigen::Matrix2d() << 0, -1, 1, 0).finished();

}  // namespace

PoseFilter::PoseFilter(const FieldModel& field, const VisionParameters::PoseFilter& parameters)
    : field_(&field), parameters_(parameters) {
  start(Pose2{}, 1, 1);
}

void PoseFilter::start(const Pose2& pose, double position_sigma, double heading_sigma,
                       const Eigen::Vector2d& tilt) {
  state_ << pose.position, wrapped(pose.heading), tilt, 0, 0;
  State variances;
  variances << square(position_sigma), square(position_sigma), square(heading_sigma),
      square(parameters_.tilt_sigma), square(parameters_.tilt_sigma),
      square(parameters_.tilt_noise), square(parameters_.tilt_noise);
  covariance_ = variances.asDiagonal();
}

void PoseFilter::predict(const Pose2& step, double dt) {
  const Eigen::Vector2d way = pose().rotate(step.position);
  state_.head<2>() += way;
  state_[2] = wrapped(state_[2] + step.heading);
  // A heading error rotates the path: d(way)/d(heading) = (-way_y, way_x).
  Covariance transition = Covariance::Identity();
  transition(0, 2) = -way.y();
  transition(1, 2) = way.x();
  const double decay = std::exp(-dt / parameters_.tilt_time);
  transition(3, 3) = transition(4, 4) = decay;
  state_.segment<2>(3) *= decay;
  // The noise of the last image says nothing about the next one.
  transition(5, 5) = transition(6, 6) = 0;
  state_.tail<2>().setZero();
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  const double distance = way.norm();
  const double turn = std::abs(wrapped(step.heading));
  const double position = square(parameters_.position_per_way) * distance +
                          square(parameters_.position_per_turn) * turn +
                          square(parameters_.position_per_time) * dt;
  const double heading = square(parameters_.heading_per_way) * distance +
                         square(parameters_.heading_per_turn) * turn +
                         square(parameters_.heading_per_time) * dt;
  const double tilt = square(parameters_.tilt_sigma) * (1 - decay * decay);
  State added;
  added << position, position, heading, tilt, tilt, square(parameters_.tilt_noise),
      square(parameters_.tilt_noise);
  covariance_.diagonal() += added;
}

void PoseFilter::spread(double position_sigma, double heading_sigma) {
  covariance_.diagonal().head<3>() +=
      Eigen::Vector3d(square(position_sigma), square(position_sigma), square(heading_sigma));
}

Eigen::Vector2d PoseFilter::on_field(const CameraPlace& camera,
                                     const Eigen::Vector2d& point) const {
  return pose() * Eigen::Vector2d(point + tilt_jacobian(camera, point) * tilt_of_image());
}

// Field point f = t + R(theta) (p + G (a, b)), with the tilt (a, b); measured is its component
// along `direction`.
PoseFilter::Row PoseFilter::make_row(const CameraPlace& camera, const Eigen::Vector2d& point,
                                     const Eigen::Vector2d& direction, double target,
                                     double extra_variance) const {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(state_[2]).toRotationMatrix();
  const Eigen::Matrix2d G = tilt_jacobian(camera, point);
  const Eigen::Vector2d corrected = point + G * tilt_of_image();
  Row row;
  row.jacobian.head<2>() = direction.transpose();
  row.jacobian[2] = direction.dot(R * kQuarterTurn * corrected);
  row.jacobian.segment<2>(3) = row.jacobian.tail<2>() = direction.transpose() * R * G;
  row.innovation = target - direction.dot(state_.head<2>() + R * corrected);
  // A pixel covers (r^2 + h^2) / h along the view on the ground and sqrt(r^2 + h^2) across it.
  const Eigen::Vector2d P = point - camera.position.head<2>();
  const double h = camera.position.z();
  const double square_range = P.squaredNorm() + h * h;
  const double angle = parameters_.pixel_sigma * camera.pixel_angle;
  const Eigen::Vector2d in_heading = R.transpose() * direction;
  const Eigen::Vector2d view =
      P.norm() > 1e-6 ? Eigen::Vector2d(P.normalized()) : Eigen::Vector2d::UnitX();
  const double along = square(in_heading.dot(view));
  row.variance = along * square(angle * square_range / h) +
                 (1 - along) * square(angle) * square_range + extra_variance;
  return row;
}

PoseFilter::Measurement::Measurement(const Row& a, const Row& b)
    : innovation(a.innovation, b.innovation),
      covariance(Eigen::Vector2d(a.variance, b.variance).asDiagonal()) {
  jacobian << a.jacobian, b.jacobian;
}

Eigen::Matrix2d PoseFilter::innovation_covariance(const Measurement& measurement) const {
  const auto& H = measurement.jacobian;
  return H * covariance_ * H.transpose() + measurement.covariance;
}

double PoseFilter::distance(const Measurement& measurement) const {
  const Eigen::Vector2d& innovation = measurement.innovation;
  return innovation.dot(innovation_covariance(measurement).inverse() * innovation);
}

// A straight line through an arc with the sagitta s lies within s of it: its ends 2/3 s outside.
PoseFilter::Match PoseFilter::match_chord(const CameraPlace& camera, const FieldLine& line) const {
  const double radius = field_->circle_radius();
  const double chord = (line.to - line.from).norm();
  if (chord > 2 * radius * parameters_.most_chord) return {};
  const double sagitta = radius - std::sqrt(square(radius) - square(chord / 2));
  const double variance = square(parameters_.line_sigma) + square(sagitta / 3);
  const Eigen::Vector2d from = on_field(camera, line.from);
  const Eigen::Vector2d to = on_field(camera, line.to);
  if (std::min(from.norm(), to.norm()) < 1e-3) return {};
  const double distance = radius + sagitta * 2 / 3;
  return Measurement(make_row(camera, line.from, from.normalized(), distance, variance),
                     make_row(camera, line.to, to.normalized(), distance, variance));
}

// Both ends of an observed line lie on the field line: two rows across it. Or both lie on the
// center circle.
PoseFilter::Match PoseFilter::match_line(const CameraPlace& camera, const FieldLine& line) const {
  const Eigen::Vector2d from = on_field(camera, line.from);
  const Eigen::Vector2d to = on_field(camera, line.to);
  const Eigen::Vector2d direction = (to - from).normalized();
  double best = std::numeric_limits<double>::infinity();
  double second = best;
  Match best_match;
  const auto add = [&](const Measurement& measurement) {
    const double d = distance(measurement);
    second = std::min(second, std::max(d, best));
    if (d >= best) return;
    best = d;
    best_match.emplace(measurement);
  };
  if (const Match chord = match_chord(camera, line)) add(*chord);
  for (const FieldLine& candidate : field_->lines()) {
    const Eigen::Vector2d along = (candidate.to - candidate.from).normalized();
    if (std::abs(along.dot(direction)) < std::cos(parameters_.most_angle)) continue;
    const double length = (candidate.to - candidate.from).norm();
    const double position_sigma = std::sqrt(std::max(covariance_(0, 0), covariance_(1, 1)));
    const double beyond =
        parameters_.beyond + 2 * position_sigma +
        parameters_.beyond_per_distance * std::max(line.from.norm(), line.to.norm());
    const double s = (from - candidate.from).dot(along);
    const double t = (to - candidate.from).dot(along);
    if (std::min(s, t) < -beyond || std::max(s, t) > length + beyond) continue;
    const Eigen::Vector2d normal = kQuarterTurn * along;
    const double offset = normal.dot(candidate.from);
    const double variance = square(parameters_.line_sigma);
    add(Measurement(make_row(camera, line.from, normal, offset, variance),
                    make_row(camera, line.to, normal, offset, variance)));
  }
  if (best > parameters_.gate || second < best + parameters_.unique) return {};
  return best_match;
}

PoseFilter::Match PoseFilter::match_point(const CameraPlace& camera, const Eigen::Vector2d& point,
                                          const Eigen::Vector2d& target, double radial_variance,
                                          double tangential_variance) const {
  // Along and across the view, in which the noise is independent.
  const Eigen::Vector2d view = pose().rotate((point - camera.position.head<2>()).normalized());
  const Eigen::Vector2d side = kQuarterTurn * view;
  const Measurement measurement(
      make_row(camera, point, view, view.dot(target), radial_variance),
      make_row(camera, point, side, side.dot(target), tangential_variance));
  if (distance(measurement) > parameters_.gate) return {};
  return measurement;
}

PoseFilter::Match PoseFilter::match_circle(const CameraPlace& camera,
                                           const Eigen::Vector2d& circle) const {
  const double range = (circle - camera.position.head<2>()).norm();
  const double variance =
      square(parameters_.circle_sigma + parameters_.circle_sigma_per_distance * range);
  return match_point(camera, circle, Eigen::Vector2d::Zero(), variance, variance);
}

PoseFilter::Match PoseFilter::match_post(const CameraPlace& camera,
                                         const Eigen::Vector2d& post) const {
  const Eigen::Vector2d seen = on_field(camera, post);
  const auto nearest = std::min_element(field_->goal_posts().begin(), field_->goal_posts().end(),
                                        [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                                          return (a - seen).norm() < (b - seen).norm();
                                        });
  if (nearest == field_->goal_posts().end()) return {};
  const double range = (post - camera.position.head<2>()).norm();
  return match_point(camera, post, *nearest, square(parameters_.post_distance_sigma * range),
                     square(parameters_.post_side_sigma));
}

// The lines are used one after the other: a line that fits the field only with a tilt that the
// others exclude is a false one, or another line than it seemed before.
void PoseFilter::update(const FieldObservation& observation) {
  const CameraPlace& camera = observation.camera;
  std::vector<std::pair<double, std::function<Match()>>> landmarks;
  const auto add = [&](std::function<Match()> match) {
    const Match first = match();
    const double d = first ? distance(*first) : std::numeric_limits<double>::infinity();
    landmarks.emplace_back(d, std::move(match));
  };
  for (const FieldLine& line : observation.lines) {
    add([this, &camera, &line] { return match_line(camera, line); });
  }
  if (observation.circle) {
    add([this, &camera, &observation] { return match_circle(camera, *observation.circle); });
  }
  for (const Eigen::Vector2d& post : observation.posts) {
    add([this, &camera, &post] { return match_post(camera, post); });
  }
  std::stable_sort(landmarks.begin(), landmarks.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& landmark : landmarks) {
    if (const Match match = landmark.second()) apply(*match);
  }
}

void PoseFilter::apply(const Measurement& measurement) {
  const auto& H = measurement.jacobian;
  const Eigen::Matrix2d& R = measurement.covariance;
  const Eigen::Matrix2d S = innovation_covariance(measurement);
  // K = P H^T S^-1.
  const Eigen::Matrix<double, 7, 2> gain = S.llt().solve(H * covariance_).transpose();
  state_ += gain * measurement.innovation;
  state_[2] = wrapped(state_[2]);
  // Joseph form: stays symmetric and positive definite.
  const Covariance factor = Covariance::Identity() - gain * H;
  covariance_ = (factor * covariance_ * factor.transpose() + gain * R * gain.transpose()).eval();
}

}  // namespace nao::vision
