#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Force of the ground on one foot. */
struct FootReaction {
  /** Vertical force, N, never negative. */
  double force = 0;
  /** Center of pressure on the sole, m, torso frame; the sole's origin where there is no force. */
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/** Estimates the ground reaction on both feet from joint torques and the direction of gravity, for
 * robots without foot force sensors.
 *
 * Unknown are force f_i and moment m_i on each sole. They follow from a weighted least-squares
 * solution of
 *
 *     tau_j = M g up^T J_com,j - sum_i (f_i^T J_v,ij + m_i^T J_w,ij)   each motor j of the legs,
 *     M g up = sum_i f_i,     0 = sum_i ((p_i - c) x f_i + m_i)        the whole body.
 *
 * The first line is the virtual work of the joints with the torso fixed (as in ServoFeedforward).
 * The second one is Newton's and Euler's equation of a body that neither accelerates much nor
 * changes its angular momentum; its weight is lower. It gives the force along a stretched leg,
 * which no joint carries. A swing leg needs torques for its own acceleration; therefore the higher
 * a foot is above the other one, the smaller its expected force. A robot that hangs with stretched
 * legs cannot be distinguished from one that stands.
 *
 * Source: contact forces from joint torques as in M. Camurri et al., "Probabilistic contact
 * estimation and impact detection for state estimation of quadruped robots", IEEE RA-L 2(2), 2017.
 */
class GroundReaction {
 public:
  /** @param model  Must outlive this. */
  explicit GroundReaction(const RobotModel& model);

  /** @param kinematics  Kinematics of the measured angles. @param torque  Measured, N m,
   * (num_motors).
   * @param up  Unit vector upwards, torso frame. @return Left foot, right foot. */
  std::array<FootReaction, 2> estimate(const Kinematics& kinematics,
                                       const std::vector<double>& torque,
                                       const Eigen::Vector3d& up) const;

 private:
  const RobotModel* model_;
  double weight_;
  /** Motors between the root and a sole. */
  std::vector<int> motors_;
  /** Height of the root over the soles at the angle 0 of all joints, m: the scale of moments. */
  double height_;
  /** Bounds of each sole's outline, m: least and greatest x and y. */
  std::array<Eigen::AlignedBox2d, 2> soles_;
};

}  // namespace nao::motion
