#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** How a robot with stiff joints comes to rest on its soles. */
struct Rest {
  /** Direction of up in the torso frame, unit. */
  Eigen::Vector3d up_in_torso = Eigen::Vector3d::UnitZ();
  /** Cosine of the angle between up and the normal of the sole that is nearer to level. */
  double flattest = 1;
  /** How far the other sole's edge would reach below the flat one, m. */
  double lifting = 0;
  /** From the centre of mass's ground projection to the edge of what it stands on, m; negative if
   * the robot tips farther than looked for. */
  double margin = 0;
  /** Way to the nearest edge, unit, horizontal, torso frame: where it tips to. */
  Eigen::Vector3d tipping_direction = Eigen::Vector3d::UnitX();
};

/** Foresees whether joint angles would tip a standing robot over.
 *
 * Treats the robot as one stiff body and lets it roll over the edges of its soles, from how it
 * stands now, until its centre of mass is above what it stands on. A tilt of more than a few
 * degrees on the way there counts as tipping over. Slow motions only: momentum is not looked at. */
class TippingGuard {
 public:
  explicit TippingGuard(const RobotModel& model);

  /** @param position     Joint angles, rad, (num_motors).
   * @param up_in_torso   Where it starts to roll from, unit. */
  Rest find_rest(const std::vector<double>& position, const Eigen::Vector3d& up_in_torso);

  /** How a robot that is said to stand on its soles really stands, if it is at rest: on a face of
   * the hull of its soles' corners. The inertial unit's up tells which face; the joints tell how it
   * lies, for an error of one degree there is 3 mm of height between the feet.
   * @param up_in_torso  As measured, unit.
   * @return Up of that face, unit; as measured if no face is as near as the measurement's error. */
  Eigen::Vector3d find_standing_up(const std::vector<double>& position,
                                   const Eigen::Vector3d& up_in_torso);

  /** Share of the straight way from one set of angles to another that keeps the balance.
   * @param up_in_torso  How the robot stands at the beginning, unit.
   * @param tipping      Set if the answer is below 1: the rest that is none.
   * @return 0..1; 1 if the whole way does. */
  double find_safe_share(const std::vector<double>& from, const std::vector<double>& to,
                         const Eigen::Vector3d& up_in_torso, Rest& tipping);

 private:
  Kinematics kinematics_;
};

}  // namespace nao::motion
