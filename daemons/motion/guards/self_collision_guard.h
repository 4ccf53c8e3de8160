#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/closest_points.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** A predicted collision of two links. */
struct SelfCollision {
  std::string link_a;
  std::string link_b;
  /** Motor of the path whose joint contributes most to the approach of the two links. */
  int motor = -1;
};

/** Predicts collisions of the robot with itself from the distances between the collision primitives
 * of its URDF. Pairs of links that may touch (RobotModel::allowed_contacts()) are not checked. */
class SelfCollisionGuard {
 public:
  /** Least distance of two links, m. Chosen: a reserve for the servos' tracking error and the
   * encoders' resolution. */
  static constexpr double kClearance = 0.003;

  /** @param model      Must outlive this.
   * @param clearance  Least distance of two links on a path, m, at least 0.
   * @throws ModelError  for a collision shape that is not a box, sphere or capsule. */
  explicit SelfCollisionGuard(const RobotModel& model, double clearance = kClearance);

  /** Least distance of all pairs of links, m; negative if two overlap.
   * @param position  rad, (num_motors). */
  double calc_clearance(const std::vector<double>& position);

  /** Finds the part of a path without self-collision. Links that touch at its start may keep
   * touching, but not deeper.
   * @param path       Joint angles, rad, each (num_motors), so dense that no link passes another
   *   between two of them. Not empty.
   * @param collision  Set if the path is not free to its end.
   * @return Index of the last point before the collision, or of the last point. */
  size_t find_last_free(const std::vector<std::vector<double>>& path, SelfCollision& collision);

 private:
  /** A collision primitive. */
  struct Part {
    int link;
    RoundedBox box_in_link;
    /** Radius of a sphere about the primitive's center that contains it, m. */
    double bounding_radius;
  };

  void place(const std::vector<double>& position);
  /** Distance of a pair of parts, m, or a lower bound of it that is above `enough`. */
  double distance(const std::pair<int, int>& pair, double enough) const;
  /** Motor whose part of a change reduces the distance of a pair most, at the placed angles.
   * @param change  rad, (num_motors). */
  int find_mover(const std::pair<int, int>& pair, const std::vector<double>& change) const;

  Kinematics kinematics_;
  double clearance_;
  std::vector<Part> parts_;
  /** Pairs of parts that are checked, as indices. */
  std::vector<std::pair<int, int>> pairs_;
  /** The parts in the torso frame, at the angles of the last place(). */
  std::vector<RoundedBox> placed_;
};

}  // namespace nao::motion
