#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace nao {

/** A geometric primitive or a mesh fixed to a link. */
struct Shape {
  /** A capsule is a cylinder with hemispherical ends; in the URDF it is a <cylinder> in a
   * <collision> whose name ends in "_capsule". Cylinders and capsules stand along their own z axis.
   */
  enum class Kind { kBox, kSphere, kCylinder, kCapsule, kMesh };

  std::string name;
  Kind kind = Kind::kBox;
  /** Shape frame in the link frame. */
  Eigen::Isometry3d pose_in_link = Eigen::Isometry3d::Identity();
  /** Box: full edge lengths, m. */
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  /** Sphere, cylinder, capsule: m. */
  double radius = 0;
  /** Cylinder: height; capsule: distance between the centers of its ends; m. */
  double length = 0;
  /** Mesh: absolute path of the file, which is in metres. */
  std::filesystem::path mesh;
  /** Mesh: the mirror image of what the file has, at its plane y = 0; in the URDF the scale "1 -1
   * 1". */
  bool is_mirrored = false;
};

/** A rigid link of the robot. The origin of its frame is on the axis of the joint that moves it. */
struct Link {
  std::string name;
  /** Index of the joint that moves it, -1 for the root. */
  int parent_joint = -1;
  /** kg; 0 for pure frames (sensors, cameras, soles) and for the fingers. */
  double mass = 0;
  /** Center of mass in the link frame, m. */
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();
  /** Rotational inertia about the center of mass, link axes, kg m^2. */
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  std::vector<Shape> visuals;
  std::vector<Shape> collisions;
};

/** A motor with gear and servo, all quantities at the joint. */
struct Motor {
  /** Torque that it can hold without a time limit, and for some seconds (the URDF's effort limit),
   * N m. */
  double continuous_torque = 0;
  double peak_torque = 0;
  /** Speed at which the torque has fallen to 0, rad/s. */
  double no_load_velocity = 0;
  /** Rotor inertia times gear ratio squared (armature), kg m^2. */
  double reflected_inertia = 0;
  /** Dry and viscous friction, N m and N m s/rad. */
  double dry_friction = 0;
  double viscous_friction = 0;
  /** Position servo: proportional and derivative gain, N m/rad and N m s/rad. */
  double stiffness_gain = 0;
  double damping_gain = 0;
};

/** A connection between two links. */
struct Joint {
  enum class Kind { kRevolute, kFixed };

  std::string name;
  Kind kind = Kind::kFixed;
  int parent_link = -1;
  int child_link = -1;
  /** Joint frame (equal to the child link's frame at angle 0) in the parent link's frame. */
  Eigen::Isometry3d pose_in_parent = Eigen::Isometry3d::Identity();
  /** Unit axis in the joint frame. */
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  /** rad. */
  double lower = 0;
  double upper = 0;
  /** rad/s. */
  double max_velocity = 0;
  /** N m. */
  double max_torque = 0;
  /** Index of the joint that this one mimics, -1 if it has a motor of its own or is fixed. */
  int mimic_joint = -1;
  double mimic_multiplier = 1;
  double mimic_offset = 0;
};

/** Range of one joint that depends on the angle of another: linear between the rows, constant
 * beyond the first and last one. */
struct CoupledLimit {
  /** Motor indices: the limited one and the one that its range depends on. */
  int motor = -1;
  int other_motor = -1;
  /** rad, each (num_rows); `other_position` rises. */
  std::vector<double> other_position;
  std::vector<double> lower;
  std::vector<double> upper;
};

}  // namespace nao
