#pragma once

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/closest_points.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Two links that would hit each other. */
struct SelfCollision {
  std::string link_a;
  std::string link_b;
  /** Joint of the way that moves them towards each other fastest; index of a motor. */
  int motor = -1;
};

/** Foresees whether joint angles bring the robot's links into each other, by the collision
 * primitives of its URDF. Links that may touch (RobotModel::allowed_contacts()) are left out. */
class SelfCollisionGuard {
 public:
  /** @throws ModelError  for a collision shape that is no box, sphere or capsule. */
  explicit SelfCollisionGuard(const RobotModel& model);

  /** Least distance between any two links that should not touch, m; negative if they overlap. */
  double calc_clearance(const std::vector<double>& position);

  /** How far along a way there is no self-collision. Links that touch at its beginning may go on
   * touching, no deeper.
   * @param way  Joint angles, rad, so dense that no link jumps over another.
   * @param collision  Set if the way is not free to its end. @return Index of the last point before
   * the collision, or of the last one. */
  size_t find_last_free(const std::vector<std::vector<double>>& way, SelfCollision& collision);

 private:
  struct Part {
    int link;
    RoundedBox box_in_link;
    /** Of a ball about its centre that holds it, m. */
    double bounding_radius;
  };

  void place(const std::vector<double>& position);
  /** Distance of a pair, or a lower bound of it if that is above `enough`. */
  double distance(const std::pair<int, int>& pair, double enough) const;
  /** Motor whose part of a change closes the gap of a pair most, where the parts are placed now. */
  int find_mover(const std::pair<int, int>& pair, const std::vector<double>& change) const;

  Kinematics kinematics_;
  std::vector<Part> parts_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<RoundedBox> placed_;
};

}  // namespace nao::motion
