#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "kinematics/analytic_leg_solver.h"
#include "kinematics/leg_chain.h"
#include "kinematics/numeric_leg_solver.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Result for both legs. */
struct LegsSolution {
  /** Legs with a common first motor: their first angles are equal. */
  LegAngles left{};
  LegAngles right{};
  bool is_reachable = true;
};

/** Inverse kinematics of both legs, by the method that their structure allows (Method).
 *
 * Poses are those of the soles' frames F (RobotModel::left_sole(), right_sole()) in the root's
 * frame T.
 *
 * Coupled hips (as a NAO's): the first joints of both legs, yaw-pitch axes in the plane of y and z,
 * have one motor; then roll x and pitch y, which meet the first axis in a point, knee y, and ankle
 * y and x, which meet in a point. With the thigh length a, the tibia length b, the tilt t and the
 * sign s of the yaw-pitch axis, and the angles yp, hr, hp, k, ap, ar in the order of LegAngles, the
 * leg's rotation is R_TF = Rx(t) Rz(s yp) Rx(-t) Rx(hr) Ry(hp) Ry(k) Ry(ap) Rx(ar).
 *
 * 1. The distance d from hip to ankle gives the knee by the law of cosines:
 *        cos k = (d^2 - a^2 - b^2) / (2 a b).
 * 2. The hip seen from the ankle in F, q = R_TF^T (p_hip - p_ankle), gives the ankle: its roll
 * turns q into the plane of thigh and tibia, its pitch is the angle between q and the tibia in
 * that plane: ar = atan2(q_y, q_z), ap = atan2(-a sin k, b + a cos k) - atan2(q_x, sqrt(q_y^2 +
 * q_z^2)).
 * 3. The remaining rotation gives the hip as Euler angles z, x, y:
 *        Rx(-t) R_TF Rx(-ar) Ry(-(ap + k)) = Rz(s yp) Rx(hr - t) Ry(hp).
 *
 * For a given first angle five angles remain: the position of the ankle gives the hip's roll and
 * pitch and the knee in the same way from the hip's side, and the sole's normal gives the ankle.
 *
 * No solution allocates memory.
 *
 * Source: the structure is that of C. Graf, A. Haertl, T. Roefer, T. Laue, "A robust closed-loop
 * gait for the Standard Platform League humanoid", 4th Workshop on Humanoid Soccer Robots, 2009. */
class LegKinematics {
 public:
  /** Coupled hips; AnalyticLegSolver; NumericLegSolver for all other legs. */
  enum class Method { kCoupled, kAnalytic, kNumeric };

  /** @throws ModelError  as LegChain::read(), and if both legs share a hip motor in another design
   * than the above. */
  explicit LegKinematics(const RobotModel& model);

  Method method() const { return method_; }

  /** All angles of one leg for a sole's pose; exact if the leg reaches it and has six joints or
   * more, see NumericLegSolver for those with fewer. */
  LegSolution solve(Leg leg, const Eigen::Isometry3d& sole_in_torso) const;

  /** Coupled hips: the five other angles for a given first one: the ankle's position and the sole's
   * normal are exact, the foot's heading follows from the first angle. */
  LegSolution solve_with_hip_yaw_pitch(Leg leg, const Eigen::Isometry3d& sole_in_torso,
                                       double hip_yaw_pitch) const;

  /** Both legs. Coupled hips: the first angle is the weighted mean of what solve() gives for the
   * two feet, the other angles are those of solve_with_hip_yaw_pitch(). Others: solve() for each.
   * @param left_weight  Load ratio of the left foot, 0..1: 1 while it is the only support foot, 0.5
   * in double support. */
  LegsSolution solve_both(const Eigen::Isometry3d& left_sole_in_torso,
                          const Eigen::Isometry3d& right_sole_in_torso,
                          double left_weight = 0.5) const;

  /** Writes a leg's angles into a list of all motors, (num_motors). The right leg does not write
   * the angle of a common first motor. */
  void write(Leg leg, const LegAngles& angles, std::vector<double>& position) const;
  /** Reads a leg's angles from a list of all motors. */
  LegAngles read(Leg leg, const std::vector<double>& position) const;

  /** Motors of a leg in the order of LegAngles; coupled hips have the first one in common. */
  const std::vector<int>& motors(Leg leg) const { return chain(leg).motors; }
  /** Function of each of them. */
  const LegRoles& roles(Leg leg) const { return chain(leg).roles; }
  /** Intersection of the hip axes, or else a point on the hip's pitch axis, m, root's frame. */
  const Eigen::Vector3d& hip(Leg leg) const { return hips_[index(leg)]; }
  /** Length of the stretched leg, hip to ankle, or to the sole without an ankle, m. */
  double reach() const { return reach_; }

 private:
  /** Dimensions of a leg with a coupled hip. */
  struct CoupledLeg {
    Eigen::Vector3d hip;
    /** From the ankle to the sole, m, foot frame. */
    Eigen::Vector3d sole_offset;
    /** The yaw-pitch axis is sign * Rx(tilt) z. */
    double tilt;
    double sign;
    double thigh;
    double tibia;
    /** -1 for joints that turn about -x or -y. */
    std::array<double, 6> senses;

    LegAngles with_senses(LegAngles angles) const {
      for (size_t i = 0; i < senses.size(); ++i) angles[i] *= senses[i];
      return angles;
    }
  };

  static int index(Leg leg) { return leg == Leg::kLeft ? 0 : 1; }
  const LegChain& chain(Leg leg) const { return chains_[index(leg)]; }
  static CoupledLeg read_coupled(const RobotModel& model, Leg leg);
  LegSolution solve_coupled(const CoupledLeg& leg, const Eigen::Isometry3d& sole_in_torso) const;
  void choose_method(const RobotModel& model);

  std::array<LegChain, 2> chains_;
  Method method_ = Method::kNumeric;
  // Left and right; only the pair of the chosen method has values.
  std::array<CoupledLeg, 2> coupled_{};
  std::array<std::optional<AnalyticLegSolver>, 2> analytic_;
  std::array<std::optional<NumericLegSolver>, 2> numeric_;
  std::array<Eigen::Vector3d, 2> hips_;
  double reach_ = 0;
};

}  // namespace nao
