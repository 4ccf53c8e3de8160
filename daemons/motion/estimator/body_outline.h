#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Points that may touch the ground: the soles' outlines and the corners of the collision shapes of
 * all other links. */
class BodyOutline {
 public:
  explicit BodyOutline(const RobotModel& model);

  /** Height of the lowest point relative to the torso's origin, m (negative).
   * @param R_OT  Orientation of the torso, z up. */
  double calc_lowest(const Kinematics& kinematics, const Eigen::Matrix3d& R_OT) const;

 private:
  struct Point {
    int link;
    Eigen::Vector3d position_in_link;
    /** Of the ball around the point, m. */
    double radius;
  };

  std::vector<Point> points_;
};

}  // namespace nao::motion
