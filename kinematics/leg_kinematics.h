#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

enum class Leg { kLeft = 0, kRight = 1 };

/** Angles of one leg, rad: HipYawPitch, HipRoll, HipPitch, KneePitch, AnklePitch, AnkleRoll. */
using LegAngles = std::array<double, 6>;

/** Answer of the inverse kinematics for one leg. */
struct LegSolution {
  LegAngles angles{};
  /** False if the foot is farther from the hip than the leg is long (the leg is then stretched
   * towards it), or nearer than a fully bent knee. Joint limits are not looked at. */
  bool is_reachable = true;
};

/** Answer for both legs, which share HipYawPitch. */
struct LegsSolution {
  /** Right HipYawPitch equals the left one. */
  LegAngles left{};
  LegAngles right{};
  bool is_reachable = true;
};

/** Analytic inverse kinematics of NAO's legs: three hip axes that meet in a point, a knee, two
 * ankle axes that meet in a point.
 *
 * Poses are those of the soles' frames (RobotModel::left_sole(), right_sole()) in the torso frame.
 * Formulas: the hip point seen from the foot gives knee and ankle (two links in a plane that
 * AnkleRoll turns); the rotation that is left over is HipYawPitch, HipRoll, HipPitch by Euler
 * angles about axes turned by the yaw-pitch motor's tilt. */
class LegKinematics {
 public:
  /** @throws ModelError  if the legs are not built like that. */
  explicit LegKinematics(const RobotModel& model);

  /** All six angles of one leg for a sole's pose: exact wherever the leg reaches. */
  LegSolution solve(Leg leg, const Eigen::Isometry3d& sole_in_torso) const;

  /** The five other angles for a given HipYawPitch: the ankle's position and the sole's normal are
   * exact, the foot's heading is what HipYawPitch leaves it. */
  LegSolution solve_with_hip_yaw_pitch(Leg leg, const Eigen::Isometry3d& sole_in_torso,
                                       double hip_yaw_pitch) const;

  /** Both legs: HipYawPitch as the left foot wants it times `left_share` plus as the right one
   * wants it times the rest, then the others by solve_with_hip_yaw_pitch().
   * @param left_share  0..1; 1 while only the left foot stands, 0.5 with both. */
  LegsSolution solve_both(const Eigen::Isometry3d& left_sole_in_torso,
                          const Eigen::Isometry3d& right_sole_in_torso,
                          double left_share = 0.5) const;

  /** Writes a leg's angles into a list of all motors, (num_motors). Writing the right leg leaves
   * the shared HipYawPitch as it is. */
  void write(Leg leg, const LegAngles& angles, std::vector<double>& position) const;
  /** Reads a leg's angles from a list of all motors. */
  LegAngles read(Leg leg, const std::vector<double>& position) const;

  /** Motors of a leg in the order of LegAngles; the first is the shared one for both. */
  const std::array<int, 6>& motors(Leg leg) const { return chain(leg).motors; }
  /** Where the hip axes meet, m, torso frame. */
  const Eigen::Vector3d& hip(Leg leg) const { return chain(leg).hip; }
  /** Length of the leg stretched, hip to ankle, m. */
  double reach() const { return left_.thigh + left_.tibia; }

 private:
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
