#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nao {

/** A solid primitive or a mesh fixed to a link. */
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
  /** Cylinder: height; capsule: between the centres of its ends; m. */
  double length = 0;
  /** Mesh: absolute path of the file, which is in metres. */
  std::filesystem::path mesh;
};

/** A rigid part of the robot. Its frame sits at the joint that moves it. */
struct Link {
  std::string name;
  /** Index of the joint that moves it, -1 for the root. */
  int parent_joint = -1;
  /** kg; 0 for pure frames (sensors, cameras, soles) and for the fingers. */
  double mass = 0;
  /** Centre of mass in the link frame, m. */
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();
  /** Rotational inertia about the centre of mass, link axes, kg m^2. */
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  std::vector<Shape> visuals;
  std::vector<Shape> collisions;
};

/** What moves a joint; see docs/joints.md for the sources. */
struct Motor {
  /** Torque that it can hold for ever, and for moments (the URDF's effort limit), at the joint,
   * N m. */
  double continuous_torque = 0;
  double peak_torque = 0;
  /** Speed at which its torque has fallen to 0, rad/s. */
  double no_load_velocity = 0;
  /** Rotor inertia times gear ratio squared, kg m^2. */
  double reflected_inertia = 0;
  /** Dry and viscous friction at the joint, N m and N m s/rad. */
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
  /** Index of the joint that this one follows, -1 if it has a motor of its own or is fixed. */
  int mimic_joint = -1;
  double mimic_multiplier = 1;
  double mimic_offset = 0;
};

/** Angles of all motors that make a named posture. */
struct Posture {
  std::string name;
  /** rad (hands: opening), (num_motors), in motor order. */
  std::vector<double> position;
  /** "standing", "crouching", "sitting", "lying-back" or "lying-belly". */
  std::string family;
};

/** Range of one joint that depends on the angle of another, linear between the rows; constant
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

/** Joints that a person sees as one ("left shoulder"); -1 where the group has no such axis. Indices
 * are motor indices. */
struct JointGroup {
  std::string name;
  int yaw_motor = -1;
  int pitch_motor = -1;
  int roll_motor = -1;
};

/** A camera on the robot: x along the view, y left, z up. */
struct CameraModel {
  /** "top" or "bottom", and the URDF link that is its frame. */
  std::string name;
  int link = -1;
  /** Fields of view, rad. */
  double horizontal_fov = 0;
  double vertical_fov = 0;
};

/** Greatest walking speeds that the gait holds: m/s ahead and back, m/s sideways, rad/s. */
struct WalkLimits {
  double forward = 0;
  double backward = 0;
  double sideways = 0;
  double turning = 0;
};

/** Everything that the files in robots/NAME/ say about a robot. No program knows a joint's number,
 * name or limit from anywhere else. */
class RobotModel {
 public:
  /** Reads robot.yaml, the URDF that it names, and postures.yaml from a folder.
   * @throws ModelError  naming the file, the element and what is wrong with it. */
  static RobotModel load(const std::filesystem::path& folder);

  const std::string& name() const { return name_; }
  const std::filesystem::path& folder() const { return folder_; }
  /** Absolute path of the URDF file, which robot.yaml's `urdf` names; it lies in folder(). */
  const std::filesystem::path& urdf_file() const { return urdf_file_; }

  /** All links, parents before children; the first is the root ("torso"). */
  const std::vector<Link>& links() const { return links_; }
  /** All joints, in the order of the URDF, so that a joint's parent link comes before its child. */
  const std::vector<Joint>& joints() const { return joints_; }

  /** Joints that have a motor, as indices into joints(), in the URDF's order: motor order. Fixed
   * joints and mimics are left out. */
  const std::vector<int>& motors() const { return motor_joints_; }
  int num_motors() const { return static_cast<int>(motor_joints_.size()); }
  const Joint& motor_joint(int motor) const { return joints_[motor_joints_[motor]]; }
  const Motor& motor(int motor) const { return motors_[motor]; }
  /** Names of the motors' joints, in motor order. */
  const std::vector<std::string>& motor_names() const { return motor_names_; }

  /** Index, or -1 if there is none of that name. */
  int find_link(const std::string& name) const;
  int find_joint(const std::string& name) const;
  int find_motor(const std::string& name) const;
  /** @return nullptr if there is none of that name. */
  const Posture* find_posture(const std::string& name) const;

  const std::vector<Posture>& postures() const { return postures_; }
  const std::vector<CoupledLimit>& coupled_limits() const { return coupled_limits_; }
  const std::vector<JointGroup>& joint_groups() const { return joint_groups_; }
  const std::vector<CameraModel>& cameras() const { return cameras_; }
  const WalkLimits& walk_limits() const { return walk_limits_; }
  /** Names that action_command_t may carry. */
  const std::vector<std::string>& actions() const { return actions_; }

  /** Foot force sensors: link indices of their frames, left foot first. */
  const std::vector<int>& foot_sensors() const { return foot_sensors_; }
  /** Links of the soles' frames and of the inertial unit's frames. */
  int left_sole() const { return left_sole_; }
  int right_sole() const { return right_sole_; }
  int accelerometer() const { return accelerometer_; }
  int gyroscope() const { return gyroscope_; }
  /** Convex outline of a sole, counter-clockwise from above, m, in the sole's frame. */
  const std::vector<Eigen::Vector2d>& left_sole_outline() const { return left_sole_outline_; }
  const std::vector<Eigen::Vector2d>& right_sole_outline() const { return right_sole_outline_; }
  /** Pairs of links (indices, the smaller first) that may touch without it being a self-collision.
   */
  const std::vector<std::pair<int, int>>& allowed_contacts() const { return allowed_contacts_; }

  /** Sum of all links, kg. */
  double total_mass() const;

  /** Angle of every joint of joints() from the motors' angles: mimics filled in, 0 for fixed ones.
   * @param position  rad, (num_motors), motor order. @return rad, (joints().size()). */
  std::vector<double> joint_positions(const std::vector<double>& position) const;

  /** Pose of every link in the root's frame. @param position  rad, (num_motors), motor order. */
  std::vector<Eigen::Isometry3d> link_poses(const std::vector<double>& position) const;

  /** Angle nearest to the wished one that the joint's own and coupled limits allow.
   * @param position  The other motors' angles, rad, (num_motors). */
  double clip_to_limits(int motor, double wished, const std::vector<double>& position) const;

 private:
  friend class RobotModelReader;

  std::string name_;
  std::filesystem::path folder_;
  std::filesystem::path urdf_file_;
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::vector<int> motor_joints_;
  std::vector<std::string> motor_names_;
  std::vector<Motor> motors_;
  std::vector<Posture> postures_;
  std::vector<CoupledLimit> coupled_limits_;
  std::vector<JointGroup> joint_groups_;
  std::vector<CameraModel> cameras_;
  WalkLimits walk_limits_;
  std::vector<std::string> actions_;
  std::vector<int> foot_sensors_;
  int left_sole_ = -1;
  int right_sole_ = -1;
  int accelerometer_ = -1;
  int gyroscope_ = -1;
  std::vector<Eigen::Vector2d> left_sole_outline_;
  std::vector<Eigen::Vector2d> right_sole_outline_;
  std::vector<std::pair<int, int>> allowed_contacts_;
};

}  // namespace nao
