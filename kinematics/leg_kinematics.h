#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

enum class Leg { kLeft = 0, kRight = 1 };

/** Angles of one leg, rad: HipYawPitch, HipRoll, HipPitch, KneePitch, AnklePitch, AnkleRoll. */
using LegAngles = std::array<double, 6>;

/** Result of the inverse kinematics for one leg. */
struct LegSolution {
  LegAngles angles{};
  /** False if the foot is farther from the hip than the leg is long (the leg is then stretched
   * towards it), or nearer than with a fully bent knee. Joint limits are not considered. */
  bool is_reachable = true;
};

/** Result for both legs, which have one common HipYawPitch. */
struct LegsSolution {
  /** Right HipYawPitch equals the left one. */
  LegAngles left{};
  LegAngles right{};
  bool is_reachable = true;
};

/** Analytic inverse kinematics of NAO's legs: three hip axes that meet in a point, a knee, two
 * ankle axes that meet in a point.
 *
 * Poses are those of the soles' frames F (RobotModel::left_sole(), right_sole()) in the torso frame
 * T. With the thigh length a, the tibia length b, the tilt t (45 degrees on a NAO) and the sign s
 * of the yaw-pitch axis, and the angles yp, hr, hp, k, ap, ar in the order of LegAngles, the leg's
 * rotation is R_TF = Rx(t) Rz(s yp) Rx(-t) Rx(hr) Ry(hp) Ry(k) Ry(ap) Rx(ar).
 *
 * 1. The distance d from hip to ankle gives the knee by the law of cosines:
 *        cos k = (d^2 - a^2 - b^2) / (2 a b).
 * 2. The hip seen from the ankle in F, q = R_TF^T (p_hip - p_ankle), gives the ankle: AnkleRoll
 * turns q into the plane of thigh and tibia, AnklePitch is the angle between q and the tibia in
 * that plane: ar = atan2(q_y, q_z), ap = atan2(-a sin k, b + a cos k) - atan2(q_x, sqrt(q_y^2 +
 * q_z^2)).
 * 3. The remaining rotation gives the hip as Euler angles z, x, y:
 *        Rx(-t) R_TF Rx(-ar) Ry(-(ap + k)) = Rz(s yp) Rx(hr - t) Ry(hp).
 *
 * For a given HipYawPitch five angles remain: the position of the ankle gives HipRoll, HipPitch and
 * the knee in the same way from the hip's side, and the sole's normal gives the ankle.
 *
 * Source: the structure is that of C. Graf, A. Haertl, T. Roefer, T. Laue, "A robust closed-loop
 * gait for the Standard Platform League humanoid", 4th Workshop on Humanoid Soccer Robots, 2009. */
class LegKinematics {
 public:
  /** @throws ModelError  if the legs are not built like that. */
  explicit LegKinematics(const RobotModel& model);

  /** All six angles of one leg for a sole's pose; exact wherever the leg reaches. */
  LegSolution solve(Leg leg, const Eigen::Isometry3d& sole_in_torso) const;

  /** The five other angles for a given HipYawPitch: the ankle's position and the sole's normal are
   * exact, the foot's heading follows from HipYawPitch. */
  LegSolution solve_with_hip_yaw_pitch(Leg leg, const Eigen::Isometry3d& sole_in_torso,
                                       double hip_yaw_pitch) const;

  /** Both legs: HipYawPitch is the weighted mean of what solve() gives for the two feet, the other
   * angles are those of solve_with_hip_yaw_pitch().
   * @param left_weight  Of the left foot, 0..1: 1 while it is the only support foot, 0.5 in double
   *   support. */
  LegsSolution solve_both(const Eigen::Isometry3d& left_sole_in_torso,
                          const Eigen::Isometry3d& right_sole_in_torso,
                          double left_weight = 0.5) const;

  /** Writes a leg's angles into a list of all motors, (num_motors). The right leg does not write
   * the common HipYawPitch. */
  void write(Leg leg, const LegAngles& angles, std::vector<double>& position) const;
  /** Reads a leg's angles from a list of all motors. */
  LegAngles read(Leg leg, const std::vector<double>& position) const;

  /** Motors of a leg in the order of LegAngles; both legs have the first one in common. */
  const std::array<int, 6>& motors(Leg leg) const { return chain(leg).motors; }
  /** Intersection of the hip axes, m, torso frame. */
  const Eigen::Vector3d& hip(Leg leg) const { return chain(leg).hip; }
  /** Length of the stretched leg, hip to ankle, m. */
  double reach() const { return left_.thigh + left_.tibia; }

 private:
  /** Dimensions of one leg. */
  struct Chain {
    std::array<int, 6> motors;
    Eigen::Vector3d hip;
    /** From the ankle to the sole, m, foot frame. */
    Eigen::Vector3d sole_offset;
    /** The yaw-pitch axis is sign * Rx(tilt) z. */
    double tilt;
    double sign;
    double thigh;
    double tibia;
  };

  const Chain& chain(Leg leg) const { return leg == Leg::kLeft ? left_ : right_; }
  static Chain read_chain(const RobotModel& model, const char* prefix, int sole);

  Chain left_;
  Chain right_;
};

}  // namespace nao
