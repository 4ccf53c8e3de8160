#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "daemons/motion/generators/kick_trajectory.h"
#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"

namespace nao::motion {

/** Torso pose and leg angles that realize a KickReference; frames as in KickMotion.
 *
 * The torso keeps its height and tilt of the start, is placed such that the CoM is at its
 * reference, and turns: the legs of a NAO share the joint HipYawPitch. Let y_left(psi) and
 * y_right(psi) be the HipYawPitch with which the inverse kinematics of the one and of the other leg
 * gives its sole the heading of the reference, psi being the torso's heading in S. Both soles have
 * their headings only if
 *     f(psi) = y_left(psi) - y_right(psi) = 0,
 * which Newton's method solves from the last control step's psi. With any other psi the kicking
 * foot, and with it the ball, turns away from the requested direction. */
class KickPose {
 public:
  KickPose(const RobotModel& model, bool is_left);

  /** Defines S. @param kinematics  Kinematics of the joint targets at the start.
   * @return The stand in S. */
  KickReference start(const Kinematics& kinematics);

  /** Chooses the torso's heading. On the ground both soles have their headings at any moment. In
   * the air the torso already has the heading that it needs at the impact, so that its rotation
   * does not yaw the support foot during the strike. In between, airborne_fraction() blends. */
  void turn_torso(const KickReference& now, const KickReference& impact);

  /** Torso in S. */
  Eigen::Isometry3d torso_in_support(const KickReference& reference) const {
    return torso_in_support(reference, heading_);
  }
  /** Writes the legs' angles, rad, for the torso of torso_in_support(). */
  void write_legs(const KickReference& reference, std::vector<double>& position) const;

  /** Follows the CoM, m, torso frame, that moves with the leg. */
  void update_com(const Eigen::Vector3d& com_in_torso, double dt);

  /** Heading of the support sole in S, rad. */
  double support_heading() const { return support_heading_; }
  /** Heading of the torso in S, rad. */
  double torso_heading() const { return heading_; }
  /** Height of the CoM above the ground at the start, m. */
  double com_height() const { return com_height_; }
  const LegKinematics& legs() const { return legs_; }

 private:
  Eigen::Isometry3d torso_in_support(const KickReference& reference, double heading) const;
  /** Left and right sole in the torso frame. */
  std::array<Eigen::Isometry3d, 2> soles_in_torso(const KickReference& reference,
                                                  double heading) const;
  double find_torso_heading(const KickReference& reference, double guess) const;

  bool is_left_;
  LegKinematics legs_;
  /** In S: its height and tilt are kept. */
  Eigen::Isometry3d start_torso_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d com_in_torso_ = Eigen::Vector3d::Zero();
  double com_height_ = 0;
  double support_heading_ = 0;
  double heading_ = 0;
  /** Solutions of the last control step, rad. */
  double exact_heading_ = 0;
  double impact_heading_ = 0;
};

}  // namespace nao::motion
