#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
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

/** A motor with gear and servo, all quantities at the joint; docs/joints.md has the sources. */
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

/** A named posture: the angles of all motors. */
struct Posture {
  std::string name;
  /** rad (hands: opening), (num_motors), in motor order. */
  std::vector<double> position;
  /** "standing", "crouching", "sitting", "lying-back" or "lying-belly". */
  std::string family;
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

/** Joints that users operate as one ("left shoulder"). Motor indices; -1 where the group has no
 * such axis. */
struct JointGroup {
  std::string name;
  int yaw_motor = -1;
  int pitch_motor = -1;
  int roll_motor = -1;
};

/** A camera on the robot. Its link's frame: x along the optical axis, y left, z up. */
struct CameraModel {
  /** "top" or "bottom", and the URDF link that is its frame. */
  std::string name;
  int link = -1;
  /** Fields of view, rad. */
  double horizontal_fov = 0;
  double vertical_fov = 0;
};

/** Largest velocities that the gait supports: m/s forward, backward and sideways, rad/s turning. */
struct WalkLimits {
  double forward = 0;
  double backward = 0;
  double sideways = 0;
  double turning = 0;
};

/** A foot: the frame and outline of its sole, and its force sensors. */
struct Foot {
  /** Link of the sole's frame: x ahead, y left, z up. */
  int sole = -1;
  /** Convex outline, counter-clockwise from above, m, in the sole's frame. */
  std::vector<Eigen::Vector2d> outline;
  /** Its force sensors, any number, as indices into RobotModel::foot_sensors(). */
  std::vector<int> sensors;
};

/** The description of a robot in robots/NAME/: links, joints, motors, postures, sensors.
 *
 * Joint numbers, limits and frames come from here only. It is a read-only record of robot.yaml, the
 * URDF and postures.yaml with an accessor for each entry, which is why it has more than 25 methods:
 * classes for parts of it would only add a name to every use. RobotModelReader fills it. */
class RobotModel {
 public:
  /** Reads robot.yaml, the URDF that it names, and postures.yaml from a folder.
   * @throws ModelError  with the file, the element and what is wrong with it. */
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
   * and mimic joints are not among them. */
  const std::vector<int>& motors() const { return motor_joints_; }
  int num_motors() const { return static_cast<int>(motor_joints_.size()); }
  const Joint& motor_joint(int motor) const { return joints_[motor_joints_[motor]]; }
  const Motor& motor(int motor) const { return motors_[motor]; }
  /** Names of the motors' joints, in motor order. */
  const std::vector<std::string>& motor_names() const { return motor_names_; }

  /** @return Index, or -1 if there is none of that name. */
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

  /** Foot force sensors of both feet: link indices of their frames, in robot.yaml's order. */
  const std::vector<int>& foot_sensors() const { return foot_sensors_; }
  /** Left, right. */
  const std::array<Foot, 2>& feet() const { return feet_; }
  /** Links of the soles' frames and of the inertial unit's frames. */
  int left_sole() const { return feet_[0].sole; }
  int right_sole() const { return feet_[1].sole; }
  int accelerometer() const { return accelerometer_; }
  int gyroscope() const { return gyroscope_; }
  const std::vector<Eigen::Vector2d>& left_sole_outline() const { return feet_[0].outline; }
  const std::vector<Eigen::Vector2d>& right_sole_outline() const { return feet_[1].outline; }
  /** Pairs of links (indices, the smaller first) whose contact is not a self-collision. */
  const std::vector<std::pair<int, int>>& allowed_contacts() const { return allowed_contacts_; }

  /** Sum of all links, kg. */
  double total_mass() const;

  /** Angle of every joint of joints() from the motors' angles, mimic joints included; 0 for fixed
   * ones. @param position  rad, (num_motors), motor order. @return rad, (joints().size()).
   * @throws std::invalid_argument  for another number of positions. */
  std::vector<double> joint_positions(const std::vector<double>& position) const;

  /** Pose of every link in the root's frame. @param position  rad, (num_motors), motor order. */
  std::vector<Eigen::Isometry3d> link_poses(const std::vector<double>& position) const;

  /** Clips an angle to the joint's own and coupled limits.
   * @param angle  rad. @param position  The other motors' angles, rad, (num_motors). */
  double clip_to_limits(int motor, double angle, const std::vector<double>& position) const;

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
  std::array<Foot, 2> feet_;
  int accelerometer_ = -1;
  int gyroscope_ = -1;
  std::vector<std::pair<int, int>> allowed_contacts_;
};

}  // namespace nao
