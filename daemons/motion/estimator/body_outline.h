#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Points of the robot that can touch the ground: corners of the soles' outlines, and corners and
 * ends of the collision shapes of all other links. */
class BodyOutline {
 public:
  explicit BodyOutline(const RobotModel& model);

  /** Height of the lowest point relative to the torso's origin, m (negative).
   * @param kinematics  Kinematics of the joint angles. @param R_OT  Orientation of the torso; O has
   * z up. */
  double calc_lowest(const Kinematics& kinematics, const Eigen::Matrix3d& R_OT) const;

 private:
  struct Point {
    int link;
    Eigen::Vector3d position_in_link;
    /** Radius of the sphere around the point, m. */
    double radius;
  };

  void add_sole(int link, const std::vector<Eigen::Vector2d>& outline);
  /** @param is_foot  Only the upper corners: the sole's outline replaces the lower ones. */
  void add_shape(int link, const Shape& shape, bool is_foot);

  std::vector<Point> points_;
};

}  // namespace nao::motion
