#include "tools/nao-trial/perception_model.h"

#include <algorithm>
#include <cmath>

#include "kinematics/formation.h"

namespace nao::trial {
namespace {

using vision::kBallRadius;

using Eigen::Vector2d;

/** m, of the ranges of recall. */
constexpr double kNear = 3;
constexpr double kFar = 5;
/** Height of the cameras in the ready posture, m, for the covariance only. */
constexpr double kHeight = 0.45;
/** Numbers of the perception's errors are independent of those of the disturbances. */
constexpr uint64_t kSeedOffset = 0x9e3779b9;

/** A point's direction seen from a camera: to the left of its axis, and below it, rad. */
Vector2d direction_in(const Eigen::Isometry3d& camera, const Eigen::Vector3d& point) {
  const Eigen::Vector3d seen = camera.inverse() * point;
  return {std::atan2(seen.y(), seen.x()), std::atan2(-seen.z(), seen.head<2>().norm())};
}

}  // namespace

PerceptionModel::PerceptionModel(ClosedLoop& trial, const PerceptionErrors& errors, uint64_t seed,
                                 int team)
    : trial_(trial),
      errors_(errors),
      field_in_world_(team_in_field(team)),
      random_((seed ^ kSeedOffset) + static_cast<uint64_t>(trial.robot())),
      kinematics_(trial.model()) {
  field_error_ = {errors_.position * random_.normal(), errors_.position * random_.normal(),
                  errors_.heading * random_.normal()};
}

// Ornstein-Uhlenbeck process: keeps the standard deviation, changes within the time constant.
void PerceptionModel::drift(double dt) {
  const double keep = std::exp(-dt / errors_.time_constant);
  const double add = std::sqrt(1 - keep * keep);
  const Eigen::Vector3d sigma(errors_.position, errors_.position, errors_.heading);
  for (int i = 0; i < 3; ++i) {
    field_error_[i] = keep * field_error_[i] + add * sigma[i] * random_.normal();
  }
}

std::optional<Vector2d> PerceptionModel::measure(const CameraModel& camera) {
  const Eigen::Isometry3d truth = trial_.world().robot(trial_.robot()).link_pose(camera.link);
  const Vector2d ball = trial_.world().ball().position.head<2>();
  const Eigen::Vector3d center(ball.x(), ball.y(), kBallRadius);
  const Vector2d direction = direction_in(truth, center);
  if (std::abs(direction.x()) > 0.5 * camera.horizontal_fov ||
      std::abs(direction.y()) > 0.5 * camera.vertical_fov) {
    return std::nullopt;
  }
  const double distance = (truth.translation().head<2>() - ball).norm();
  const double recall = distance < kNear  ? errors_.recall_near
                        : distance < kFar ? errors_.recall_far
                                          : 0;
  if (random_.uniform() >= recall) return std::nullopt;
  // The estimated camera, along the direction with its error, down to the height of the center.
  kinematics_.update(trial_.estimate().joint_position);
  const Eigen::Isometry3d estimate =
      trial_.estimate().torso_in_odometry * kinematics_.link_pose(camera.link);
  const double bearing = direction.x() + errors_.bearing * random_.normal();
  const double depression = direction.y() + errors_.depression * random_.normal();
  const Eigen::Vector3d ray =
      estimate.linear() * Eigen::Vector3d(std::cos(depression) * std::cos(bearing),
                                          std::cos(depression) * std::sin(bearing),
                                          -std::sin(depression));
  if (ray.z() > -0.02) return std::nullopt;
  const double length = (kBallRadius - estimate.translation().z()) / ray.z();
  if (length < 0 || length > 2 * kFar) return std::nullopt;
  return (estimate.translation() + length * ray).head<2>();
}

void PerceptionModel::update_ball(const Vector2d& seen) {
  const Vector2d torso = trial_.estimate().torso_in_odometry.translation().head<2>();
  // As in nao-vision, an error of the depression becomes an error of distance.
  const double distance = std::max(0.2, (seen - torso).norm());
  const double along =
      errors_.depression * (distance * distance + kHeight * kHeight) / kHeight + 0.01;
  const double across = errors_.bearing * distance + 0.01;
  const Vector2d way = (seen - torso).normalized();
  Eigen::Matrix2d axes;
  axes << way.x(), -way.y(), way.y(), way.x();
  const Vector2d variance(along * along, across * across);
  filter_.update(seen, axes * variance.asDiagonal() * axes.transpose());
}

void PerceptionModel::take_image(const CameraModel& camera) {
  filter_.predict(trial_.estimate().utime);
  if (const auto seen = measure(camera)) {
    update_ball(*seen);
  } else if (random_.uniform() < errors_.false_balls) {
    const Eigen::Isometry3d& estimate = trial_.estimate().torso_in_odometry;
    const Vector2d place(random_.uniform(0.4, kNear), random_.uniform(-1, 1));
    update_ball(Pose2::from(estimate) * place);
  }
  play::Vision vision;
  vision.time = trial_.time();
  const vision::BallEstimate& estimate = filter_.estimate();
  if (estimate.is_known) {
    vision.ball = play::Ball{estimate.state.head<2>(), estimate.state.tail<2>(),
                             1e-6 * static_cast<double>(estimate.seen_utime), estimate.is_rolling};
  }
  const Pose2 torso_in_field = field_in_world_.inverse() * Pose2::from(trial_.torso_in_world());
  const Pose2 seen_in_field{torso_in_field.position + field_error_.head<2>(),
                            torso_in_field.heading + field_error_.z()};
  vision.field_in_odometry =
      Pose2::from(trial_.estimate().torso_in_odometry) * seen_in_field.inverse();
  vision.robots = see_robots(camera);
  pending_.push_back({trial_.time() + kImageLatency, vision});
}

std::vector<Vector2d> PerceptionModel::see_robots(const CameraModel& camera) {
  std::vector<Vector2d> result;
  const Eigen::Isometry3d truth = trial_.world().robot(trial_.robot()).link_pose(camera.link);
  const Pose2 torso = Pose2::from(trial_.torso_in_world());
  for (int other = 0; other < trial_.world().num_robots(); ++other) {
    if (other == trial_.robot()) continue;
    const Eigen::Vector3d place = trial_.world().robot(other).link_pose(0).translation();
    const double distance = (place.head<2>() - torso.position).norm();
    const Vector2d direction = direction_in(truth, place);
    // A robot is tall: it is in the image whenever the camera looks roughly towards it.
    if (distance > kNear || std::abs(direction.x()) > 0.5 * camera.horizontal_fov) continue;
    if (random_.uniform() >= errors_.robot_recall) continue;
    Vector2d seen = torso.inverse() * place.head<2>();
    seen *= 1 + errors_.robot_distance * random_.normal();
    result.push_back(Pose2::from(trial_.estimate().torso_in_odometry) * seen);
  }
  return result;
}

const play::Vision& PerceptionModel::step(const std::string& camera) {
  drift(trial_.period());
  since_image_ += trial_.period();
  if (!camera.empty() && since_image_ >= 1 / errors_.rate) {
    since_image_ = 0;
    for (const CameraModel& each : trial_.model().cameras()) {
      if (each.name == camera) take_image(each);
    }
  }
  while (!pending_.empty() && pending_.front().due <= trial_.time()) {
    known_ = pending_.front().vision;
    pending_.pop_front();
  }
  return known_;
}

}  // namespace nao::trial
