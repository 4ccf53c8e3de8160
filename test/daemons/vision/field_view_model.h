#pragma once

#include <cmath>

#include "common/random.h"
#include "daemons/vision/field_model.h"
#include "daemons/vision/field_observation.h"

namespace nao::vision {

/** Observations of a robot whose camera is 0.5 m high: lines within 3.5 m and 30 degrees of its
 * heading, with noise, misses, and false lines. */
class FieldViewModel {
 public:
  /** @param field  Must outlive this. @param tilt  Error of the camera's tilt that stays, rad; a
   * smaller one is drawn and added. */
  FieldViewModel(const FieldModel& field, uint64_t seed,
                 const Eigen::Vector2d& tilt = Eigen::Vector2d::Zero())
      : field_(field), random_(seed) {
    bias_ = {0.006 * random_.normal(), 0.006 * random_.normal()};
    bias_ += tilt;
  }

  FieldObservation observe(const Pose2& truth, const Pose2& odometry) {
    FieldObservation observation;
    observation.heading_in_odometry = odometry;
    observation.camera = {{0, 0, 0.5}, 0.0018};
    const Eigen::Vector2d tilt =
        bias_ + 0.006 * Eigen::Vector2d(random_.normal(), random_.normal());
    const Pose2 inverse = truth.inverse();
    const auto seen = [&](const Eigen::Vector2d& point) {
      // A pixel of noise: more along the view than across it.
      const double h = observation.camera.position.z();
      const double square_range = point.squaredNorm() + h * h;
      const Eigen::Vector2d view = point.normalized();
      const Eigen::Vector2d side(-view.y(), view.x());
      const double pixel = observation.camera.pixel_angle;
      return Eigen::Vector2d(point - tilt_jacobian(observation.camera, point) * tilt +
                             pixel * square_range / h * random_.normal() * view +
                             pixel * std::sqrt(square_range) * random_.normal() * side);
    };
    const auto is_visible = [](const Eigen::Vector2d& point) {
      return point.x() > 0.4 && point.norm() < 3.5 &&
             std::abs(std::atan2(point.y(), point.x())) < 0.52;
    };
    for (const FieldLine& line : field_.lines()) {
      std::vector<Eigen::Vector2d> points;
      for (int i = 0; i <= 100; ++i) {
        const Eigen::Vector2d point =
            inverse * Eigen::Vector2d(line.from + (line.to - line.from) * (i / 100.0));
        if (is_visible(point)) points.push_back(point);
      }
      if (points.size() < 2 || (points.back() - points.front()).norm() < 0.3) continue;
      if (random_.uniform() < 0.8) {
        observation.lines.push_back({seen(points.front()), seen(points.back())});
      }
      if (random_.uniform() < 0.1) {
        const Eigen::Vector2d middle(random_.uniform(0.6, 3), random_.uniform(-1, 1));
        const double angle = random_.uniform(0, M_PI);
        const Eigen::Vector2d half = 0.3 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        observation.lines.push_back({middle - half, middle + half});
      }
    }
    const Eigen::Vector2d center = inverse * Eigen::Vector2d(0, 0);
    if (is_visible(center) && random_.uniform() < 0.8) observation.circle = seen(center);
    return observation;
  }

 private:
  const FieldModel& field_;
  Random random_;
  Eigen::Vector2d bias_;
};

}  // namespace nao::vision
