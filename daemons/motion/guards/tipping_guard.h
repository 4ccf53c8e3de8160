#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Static equilibrium of a robot with rigid joints on its soles. */
struct Equilibrium {
  /** Direction of up in the torso frame, unit. */
  Eigen::Vector3d up_in_torso = Eigen::Vector3d::UnitZ();
  /** Cosine of the angle between up and the normal of the flatter sole. */
  double flattest = 1;
  /** Depth of the other sole's lowest corner below the flat one, m. */
  double lifting = 0;
  /** Static stability margin: distance of the center of mass's ground projection to the edge of the
   * support polygon, m; negative if the robot tips farther than the search goes. */
  double margin = 0;
  /** Direction to the nearest edge, unit, horizontal, torso frame: the robot tips there. */
  Eigen::Vector3d tipping_direction = Eigen::Vector3d::UnitX();
};

/** Predicts whether joint angles would tip a standing robot over.
 *
 * A rigid body on the ground is in static equilibrium if its center of mass projects into the
 * support polygon, the convex hull of its contact points. The robot is treated as one rigid body
 * for each sample of a path of joint angles: starting with the direction of up of the sample
 * before, the body rolls in small steps over the nearest edge of its support polygon until its
 * center of mass is above it. A roll of more than a few degrees, a flat sole that is lifted, or a
 * margin below a reserve count as tipping over. Accelerations are not considered: the paths are
 * slow.
 *
 * Source: R. B. McGhee, A. A. Frank, "On the stability properties of quadruped creeping gaits",
 * Mathematical Biosciences 3, 1968, for the static stability margin. */
class TippingGuard {
 public:
  /** @param model  Must outlive this. */
  explicit TippingGuard(const RobotModel& model) : kinematics_(model) {}

  /** Rolls the robot to its equilibrium. @param position  Joint angles, rad, (num_motors).
   * @param up_in_torso  Where the roll starts, unit. */
  Equilibrium find_equilibrium(const std::vector<double>& position,
                               const Eigen::Vector3d& up_in_torso);

  /** Corrects the measured direction of up of a robot that rests on its soles: it rests on a face
   * of the convex hull of the soles' corners, whose normal the joint angles give exactly. The
   * measurement only selects the face: one degree of its error is 3 mm of height between the feet.
   * @param up_in_torso  Measured, unit.
   * @return Normal of the face, unit; the measurement if no face is within its error. */
  Eigen::Vector3d find_support_normal(const std::vector<double>& position,
                                      const Eigen::Vector3d& up_in_torso);

  /** Finds how much of the straight line between two sets of joint angles keeps the balance.
   * @param from, to     rad, (num_motors).
   * @param up_in_torso  Measured at `from`, unit.
   * @param tipping      Set if the result is below 1: the first state without equilibrium.
   * @return Fraction of the line, 0..1. */
  double find_safe_fraction(const std::vector<double>& from, const std::vector<double>& to,
                            const Eigen::Vector3d& up_in_torso, Equilibrium& tipping);

 private:
  Kinematics kinematics_;
};

}  // namespace nao::motion
