#include "daemons/motion/estimator/body_outline.h"

#include <algorithm>
#include <limits>

namespace nao::motion {

BodyOutline::BodyOutline(const RobotModel& model) {
  add_sole(model.left_sole(), model.left_sole_outline());
  add_sole(model.right_sole(), model.right_sole_outline());
  // The link that carries the sole's frame.
  const auto foot_of = [&](int sole) {
    return model.joints()[model.links()[sole].parent_joint].parent_link;
  };
  const int left_foot = foot_of(model.left_sole());
  const int right_foot = foot_of(model.right_sole());
  for (int link = 0; link < static_cast<int>(model.links().size()); ++link) {
    const bool is_foot = link == left_foot || link == right_foot;
    for (const Shape& shape : model.links()[link].collisions) add_shape(link, shape, is_foot);
  }
}

void BodyOutline::add_sole(int link, const std::vector<Eigen::Vector2d>& outline) {
  // Soles have points of radius 0 at the corners of their outlines.
  for (const Eigen::Vector2d& corner : outline) {
    points_.push_back({link, {corner.x(), corner.y(), 0}, 0});
  }
}

void BodyOutline::add_shape(int link, const Shape& shape, bool is_foot) {
  const auto add = [&](double x, double y, double z, double radius) {
    points_.push_back({link, shape.pose_in_link * Eigen::Vector3d(x, y, z), radius});
  };
  switch (shape.kind) {
    case Shape::Kind::kSphere:
      add(0, 0, 0, shape.radius);
      break;
    case Shape::Kind::kCapsule:
      add(0, 0, shape.length / 2, shape.radius);
      add(0, 0, -shape.length / 2, shape.radius);
      break;
    case Shape::Kind::kBox: {
      const Eigen::Vector3d half = shape.size / 2;
      for (double x : {-half.x(), half.x()}) {
        for (double y : {-half.y(), half.y()}) {
          // Lower corners of a foot's box are left out: the sole's outline stands for them.
          if (!is_foot) add(x, y, -half.z(), 0);
          add(x, y, half.z(), 0);
        }
      }
      break;
    }
    case Shape::Kind::kCylinder:
    case Shape::Kind::kMesh:
      break;  // No robot's collision shapes: SelfCollisionGuard rejects them.
  }
}

double BodyOutline::calc_lowest(const Kinematics& kinematics, const Eigen::Matrix3d& R_OT) const {
  // Third row of R_OT: the vertical of odometry in the torso frame. Only heights are needed.
  const Eigen::Vector3d up = R_OT.row(2).transpose();
  double lowest = std::numeric_limits<double>::infinity();
  for (const Point& point : points_) {
    const double height =
        up.dot(kinematics.link_pose(point.link) * point.position_in_link) - point.radius;
    lowest = std::min(lowest, height);
  }
  return lowest;
}

}  // namespace nao::motion
