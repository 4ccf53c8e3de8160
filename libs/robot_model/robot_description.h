#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

namespace nao {

/** A side of the robot. */
enum class Side { kNone, kLeft, kRight };

/** A named posture: the angles of all motors. */
struct Posture {
  std::string name;
  /** rad (hands: opening), (num_motors), in motor order. */
  std::vector<double> position;
  /** "standing", "crouching", "sitting", "lying-back" or "lying-belly". */
  std::string family;

  // Not starts_with(): the sources of Simbody are C++17.
  bool is_lying() const { return family.rfind("lying", 0) == 0; }
};

/** Joints that users operate as one ("left shoulder"). Motor indices; -1 where the group has no
 * such axis. */
struct JointGroup {
  std::string name;
  int yaw_motor = -1;
  int pitch_motor = -1;
  int roll_motor = -1;
  /** Its pitch is an opening, 0 to 1, such as a hand's. */
  bool is_opening = false;
};

/** A camera on the robot. Its link's frame: x along the optical axis, y left, z up. */
struct CameraModel {
  /** Name, and the URDF link that is its frame. */
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

/** A leg: the frame and outline of its sole, its force sensors, its joints. */
struct LegDescription {
  /** Link of the sole's frame: x ahead, y left, z up. */
  int sole = -1;
  /** Convex outline, counter-clockwise from above, m, in the sole's frame. */
  std::vector<Eigen::Vector2d> outline;
  /** Its force sensors, any number, as indices into RobotModel::foot_sensors(). */
  std::vector<int> sensors;
  /** Joints that move from the root to the sole, as indices into joints(), root first. Joints
   * between the root and both legs (a waist) are in both lists. */
  std::vector<int> joints;
};

/** An arm: the frame of its hand, and the joints from the root to it. */
struct ArmDescription {
  int hand = -1;
  /** As in LegDescription. */
  std::vector<int> joints;
};

/** A joint and its mirror image, which keyframes and poses can name together. */
struct JointPair {
  std::string name;
  /** Motor indices; `right` is -1 for a joint that is its own mirror image. */
  int left = -1;
  int right = -1;
};

/** The motor on the other side, or the motor itself, and the factor of its mirrored angle: 1 or -1.
 */
struct MirrorMotor {
  int motor = -1;
  double sign = 1;
};

/** Left-right symmetry of the joints. */
struct Symmetry {
  std::vector<JointPair> pairs;
  /** (num_motors), motor order. */
  std::vector<MirrorMotor> mirrors;

  /** @return nullptr if there is none of that name. */
  const JointPair* find_pair(const std::string& name) const;
};

/** Folder of a robot's policies, file of each, and the action that ends the use of one that walks.
 */
inline constexpr const char* kPolicyFolder = "policies";
inline constexpr const char* kPolicyFile = "policy.yaml";
inline constexpr const char* kOwnGaitAction = "own-gait";

/** An action that users can start by its name. */
struct Action {
  /** kPolicy: a folder in policies/ (docs/policies.md); kOwnGait: back from a policy that walks. */
  enum class Kind { kStandUp, kRest, kKick, kBlock, kDive, kGesture, kPolicy, kOwnGait };

  std::string name;
  Kind kind = Kind::kGesture;
  /** Side of kicks and dives. */
  Side side = Side::kNone;
  /** Blocks, dives and gestures: name of the keyframe motion that is played. */
  std::string keyframes;
};

/** Angles while the robot falls, rad, (num_motors) each; NaN: the joint keeps its target. */
struct FallPoses {
  std::vector<double> forward;
  std::vector<double> backward;
  std::vector<double> sideways;
};

/** How a joint of an arm moves during a walk. */
struct WalkingArmJoint {
  int motor = -1;
  /** rad. */
  double angle = 0;
  /** Factor of the gait's swing angle, which is positive while the right foot leads. */
  double swing = 0;
};

/** Heights by which the state of the body is recognized, m. */
struct BodyHeights {
  /** Height of the root above the ground in the ready posture. */
  double standing = 0;
  /** An upright robot is on its feet if the root is above this height; below, it sits. */
  double on_feet = 0;
};

/** Forces by which ground contact is detected, N. */
struct ContactForces {
  /** Least force on a foot in contact. */
  double contact = 0;
  /** Difference of the feet's loads at which the other one becomes the support foot. */
  double support_switch = 0;
};

/** Bounds of a stance in which a walk can begin, m. */
struct WalkingStance {
  /** Distance of the soles from each other. */
  double least_width = 0;
  double greatest_width = 0;
  /** Greatest distance of one sole ahead of the other. */
  double greatest_lead = 0;
  /** Least height of the hips above the soles. */
  double least_hip_height = 0;
};

/** Reference postures and poses of the robot's own motions. */
struct MotionReferences {
  /** Names of the postures in which walks and actions begin, in which the robot is upright, and in
   * which the motors carry no load. */
  std::string ready;
  std::string stand;
  std::string rest;
  FallPoses fall;
  std::vector<WalkingArmJoint> walking_arms;
  BodyHeights heights;
  ContactForces contact_forces;
  WalkingStance walking_stance;
};

/** People's words for one of the robot's names. */
struct Label {
  /** "posture", "action", "group" or "camera", and the name. */
  std::string kind;
  std::string name;
  /** By language ("en"). */
  std::map<std::string, std::string> texts;
};

}  // namespace nao
