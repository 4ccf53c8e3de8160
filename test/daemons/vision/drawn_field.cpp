#include "drawn_field.h"

#include <algorithm>
#include <cmath>

#include "common/random.h"

namespace nao::vision {
namespace {

const Eigen::Vector3d kWhite(215, 215, 215);
const Eigen::Vector3d kCarpet(60, 130, 50);
const Eigen::Vector3d kHall(110, 105, 115);

double distance_to(const Eigen::Vector2d& point, const Eigen::Vector4d& line) {
  const Eigen::Vector2d a = line.head<2>();
  const Eigen::Vector2d d = line.tail<2>() - a;
  const double t = std::clamp((point - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (a + t * d - point).norm();
}

/** A direction is within 0.37 rad of a corner of an icosahedron: (0, +-1, +-golden ratio), and
 * permuted. */
bool is_on_spot(const Eigen::Vector3d& direction) {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  const Eigen::Vector3d d = direction.cwiseAbs() / std::hypot(1, golden);
  const double most =
      std::max({d.y() + golden * d.z(), d.z() + golden * d.x(), d.x() + golden * d.y()});
  return most > std::cos(0.37);
}

}  // namespace

DrawnField::DrawnField(double pitch) {
  pose.translation() << 0.05, 0, 0.5;
  pose.linear() = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()).matrix();
}

Eigen::Vector3d DrawnField::ground_color(const Eigen::Vector2d& point) const {
  if (point.norm() > 8) return kHall;
  const double light = point.y() > 0 ? shadow : 1;
  for (const Eigen::Vector4d& line : lines) {
    if (distance_to(point, line) < 0.025) return light * kWhite;
  }
  if (circle && std::abs((point - *circle).norm() - 0.75) < 0.025) return light * kWhite;
  return light * kCarpet;
}

Eigen::Vector3d DrawnField::color(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d eye = pose.translation();
  if (ball) {
    const Eigen::Vector3d center(ball->x(), ball->y(), kBallRadius);
    const Eigen::Vector3d d = direction.normalized();
    const double along = (center - eye).dot(d);
    const double square = (center - eye).squaredNorm() - along * along;
    if (along > 0 && square < kBallRadius * kBallRadius) {
      const Eigen::Vector3d normal =
          (eye + d * (along - std::sqrt(kBallRadius * kBallRadius - square)) - center) /
          kBallRadius;
      // Black spots at the corners of an icosahedron, as a ball has; darker below.
      const double light = (ball->y() > 0 ? shadow : 1) * (0.8 + 0.2 * normal.z());
      return light * (is_on_spot(normal) ? Eigen::Vector3d(25, 25, 25) : kWhite);
    }
  }
  const double ground = direction.z() < -1e-6 ? -eye.z() / direction.z() : 1e9;
  if (ground > 1e8) return kHall;
  return ground_color(eye.head<2>() + ground * direction.head<2>());
}

VisionInput DrawnField::input() const {
  VisionInput input;
  input.camera = "top";
  input.calibration = calibration;
  input.pose_camera_in_heading = pose;
  input.heading_in_odometry = Pose2{};
  input.bgr.create(480, 640, CV_8UC3);
  Random random(7);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const double du : {-0.25, 0.25}) {
        for (const double dv : {-0.25, 0.25}) {
          const Eigen::Vector3d ray(1, -(u + du - calibration.cx) / calibration.fx,
                                    -(v + dv - calibration.cy) / calibration.fy);
          sum += color(pose.linear() * ray) / 4;
        }
      }
      cv::Vec3b& pixel = input.bgr.at<cv::Vec3b>(v, u);
      for (int i = 0; i < 3; ++i) {
        pixel[i] = static_cast<uint8_t>(std::clamp(sum[i] + 3 * random.normal(), 0.0, 255.0));
      }
    }
  }
  return input;
}

}  // namespace nao::vision
