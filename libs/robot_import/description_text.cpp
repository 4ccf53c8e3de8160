#include "robot_import/description_text.h"

#include <tinyxml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

#include "common/constants.h"
#include "common/error.h"
#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"
#include "robot_import/level_stance.h"
#include "robot_import/urdf_values.h"
#include "robot_import/yaml_name.h"

namespace nao {
namespace {

// How far the hips are below those of stretched legs, fraction of the leg's length.
constexpr double kReadyBend = 0.05;
constexpr double kCrouchBend = 0.2;
// Tilt of a sole in a stance, rad.
constexpr double kStanceTilt = 0.05;
// Fraction of the ankles' greatest torque that holds the center of mass while the robot stands:
// half of what a motor holds without a time limit.
constexpr double kAnkleLoad = 0.25;
// Stiffness of both ankles, in units of m g h: an inverted pendulum of the mass m and the height h
// falls below 1. Chosen: below 3 published robots sag and sway, from 4 on they stand.
constexpr double kPendulumStiffness = 5;
// Bounds of a stance are above 0 also where the legs' geometry was not understood, m.
constexpr double kLeastLength = 1e-3;
// Froude number v^2 / (g l) of the walk limits' forward velocity. Chosen: v / sqrt(g l) = 0.17, a
// slow walk that every biped of these proportions should reach.
constexpr double kFroudeVelocity = 0.17;

std::ostringstream make_stream() {
  std::ostringstream text;
  // Numbers with a point, whatever the user's locale.
  text.imbue(std::locale::classic());
  text.precision(9);
  return text;
}

/** The name of a link that is new in the robot. */
std::string make_free_name(const RobotModel& model, std::string name) {
  while (model.find_link(name) >= 0 || model.find_joint(name + "_mount") >= 0) name += "_";
  return name;
}

std::string make_sole_name(const RobotModel& model, int side) {
  return make_free_name(model, side == 0 ? "left_sole" : "right_sole");
}

// nullopt for legs without inverse kinematics: such a robot is imported, but cannot walk.
std::optional<LegKinematics> find_leg_kinematics(const RobotModel& model) {
  try {
    return LegKinematics(model);
  } catch (const ModelError&) {
    return std::nullopt;
  }
}

/** Writes the axes of a group of joints; of joints with one direction each further one gets a group
 * of its own, "head 2". */
std::string make_group(const RobotModel& model, const std::string& name, std::vector<int> motors) {
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  std::string text;
  for (int number = 1; !motors.empty(); ++number) {
    std::array<int, 3> of_direction = {-1, -1, -1};
    std::vector<int> others;
    for (const int motor : motors) {
      const Joint& joint = model.motor_joint(motor);
      Eigen::Index direction = 0;
      // At the angles 0 in the root's axes: the largest component names the direction.
      (poses[joint.child_link].linear() * joint.axis).cwiseAbs().maxCoeff(&direction);
      if (of_direction[direction] < 0) {
        of_direction[direction] = motor;
      } else {
        others.push_back(motor);
      }
    }
    const std::string number_text = number == 1 ? "" : " " + std::to_string(number);
    text += "  - {name: " + in_yaml(name + number_text);
    const std::array<const char*, 3> keys = {"roll", "pitch", "yaw"};
    for (size_t i = 0; i < keys.size(); ++i) {
      if (of_direction[i] < 0) continue;
      text += std::string(", ") + keys[i] + ": " + in_yaml(model.motor_joint(of_direction[i]).name);
    }
    text += "}\n";
    motors = others;
  }
  return text;
}

/** Motors of a chain of joints, without the ones that are known. */
std::vector<int> new_motors(const RobotModel& model, const std::vector<int>& joints,
                            std::set<int>& known) {
  std::vector<int> motors;
  for (const int joint : joints) {
    const int motor = model.motor_of(joint);
    if (motor >= 0 && known.insert(motor).second) motors.push_back(motor);
  }
  return motors;
}

/** Splits an arm or a leg into groups of at most `sizes` joints, with these names; the last one has
 * the rest. */
void add_limb_groups(const RobotModel& model, const std::string& side,
                     const std::vector<int>& motors,
                     const std::vector<std::pair<std::string, size_t>>& parts, std::string& text) {
  size_t first = 0;
  for (const auto& [name, size] : parts) {
    const bool is_last = name == parts.back().first;
    const size_t end = is_last ? motors.size() : std::min(motors.size(), first + size);
    if (first >= end) return;
    text += make_group(
        model, side + " " + name,
        {motors.begin() + static_cast<long>(first), motors.begin() + static_cast<long>(end)});
    first = end;
  }
}

/** Joints that lead to both limbs. */
std::vector<int> find_shared(const std::vector<int>& left, const std::vector<int>& right) {
  std::vector<int> shared;
  for (const int joint : left) {
    if (std::find(right.begin(), right.end(), joint) != right.end()) shared.push_back(joint);
  }
  return shared;
}

std::string make_groups(const RobotModel& model) {
  std::string text = "joint_groups:\n";
  std::set<int> known;
  std::vector<int> waist = find_shared(model.legs()[0].joints, model.legs()[1].joints);
  if (!model.arms().empty()) {
    const auto arms = find_shared(model.arms()[0].joints, model.arms()[1].joints);
    waist.insert(waist.end(), arms.begin(), arms.end());
  }
  const std::vector<int> waist_motors = new_motors(model, waist, known);
  std::string limbs;
  for (int side = 0; side < 2; ++side) {
    const std::string name = side == 0 ? "left" : "right";
    if (!model.arms().empty()) {
      const std::vector<int>& arm = model.arms()[side].joints;
      add_limb_groups(model, name, new_motors(model, arm, known),
                      {{"shoulder", 2}, {"elbow", 2}, {"wrist", 3}}, limbs);
      // What the end of the arm carries.
      std::vector<int> hand;
      for (const int joint : model.motors()) {
        if (!arm.empty() && model.moves(arm.back(), model.joints()[joint].child_link)) {
          hand.push_back(joint);
        }
      }
      limbs += make_group(model, name + " hand", new_motors(model, hand, known));
    }
    // Both legs name a motor that they share.
    std::set<int> others(waist_motors.begin(), waist_motors.end());
    const std::vector<int> leg = new_motors(model, model.legs()[side].joints, others);
    add_limb_groups(model, name, leg, {{"hip", 3}, {"knee", 1}, {"ankle", 2}}, limbs);
    known.insert(leg.begin(), leg.end());
  }
  // The other joints belong to the head, or to linkages where a limb carries them.
  std::set<int> limb_joints;
  for (const LegDescription& leg : model.legs()) {
    limb_joints.insert(leg.joints.begin(), leg.joints.end());
  }
  for (const ArmDescription& arm : model.arms()) {
    limb_joints.insert(arm.joints.begin(), arm.joints.end());
  }
  for (const int joint : waist) limb_joints.erase(joint);
  std::vector<int> head;
  std::vector<int> linkages;
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    if (known.count(motor) > 0) continue;
    const std::vector<int> chain = model.find_chain(model.motor_joint(motor).child_link);
    const bool is_on_limb = std::any_of(chain.begin(), chain.end(),
                                        [&](int joint) { return limb_joints.count(joint) > 0; });
    (is_on_limb ? linkages : head).push_back(motor);
  }
  return text + make_group(model, "head", head) + make_group(model, "waist", waist_motors) + limbs +
         make_group(model, "linkage", linkages);
}

/** Angles that bend the knees and put the center of mass over the soles; nothing if the legs do not
 * reach. */
std::optional<std::vector<double>> find_stance(const RobotModel& model, double bend,
                                               double foot_distance) {
  const auto legs = find_leg_kinematics(model);
  if (!legs) return std::nullopt;
  std::vector<double> position(model.num_motors(), 0.0);
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    // As near to 0 as the limits allow.
    position[motor] = model.clip_to_limits(motor, 0, position);
  }
  Kinematics kinematics(model);
  kinematics.update(std::vector<double>(model.num_motors(), 0.0));
  std::array<Eigen::Isometry3d, 2> straight = {kinematics.left_sole(), kinematics.right_sole()};
  // Level, also where the feet are not at the angles 0.
  const double middle = 0.5 * (straight[0].translation().y() + straight[1].translation().y());
  for (Eigen::Isometry3d& sole : straight) {
    sole.linear().setIdentity();
    double& y = sole.translation().y();
    y = middle + foot_distance * (y - middle);
  }
  // The center of mass is brought over the center of the outline, in the sole's frame, or as near
  // to it as the ankles hold it there.
  Eigen::AlignedBox2d outline;
  for (const Eigen::Vector2d& corner : model.left_sole_outline()) outline.extend(corner);
  double center = outline.center().x();
  const int role = legs->roles(Leg::kLeft).ankle_pitch;
  if (role >= 0) {
    const Joint& ankle = model.motor_joint(legs->motors(Leg::kLeft)[role]);
    const double ankle_x =
        (straight[0].inverse() * kinematics.link_pose(ankle.child_link)).translation().x();
    const double lever = kAnkleLoad * 2 * ankle.max_torque / (model.total_mass() * kGravity);
    center = std::clamp(center, ankle_x - lever, ankle_x + lever);
  }
  // The legs' own mass moves with them: a few rounds bring the center of mass over the soles.
  double ahead = 0;
  for (int round = 0; round < 6; ++round) {
    std::array<Eigen::Isometry3d, 2> soles = straight;
    for (Eigen::Isometry3d& sole : soles) {
      sole.translation().z() += bend * legs->reach();
      sole.translation().x() += ahead;
    }
    const LegsSolution solution = legs->solve_both(soles[0], soles[1]);
    if (!solution.is_reachable) return std::nullopt;
    legs->write(Leg::kLeft, solution.left, position);
    legs->write(Leg::kRight, solution.right, position);
    kinematics.update(position);
    // Fixed-point iteration: the soles move forward by the distance of the center of mass ahead of
    // them.
    ahead += kinematics.center_of_mass().x() - (kinematics.left_sole().translation().x() + center);
  }
  // Legs without an ankle reach the place, not the pose.
  for (const Eigen::Isometry3d& sole : {kinematics.left_sole(), kinematics.right_sole()}) {
    if (sole.linear().row(2).head<2>().norm() > kStanceTilt) return std::nullopt;
  }
  // A solution beyond a joint's limits is not accepted.
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    if (model.clip_to_limits(motor, position[motor], position) != position[motor]) {
      return std::nullopt;
    }
  }
  return position;
}

std::optional<std::vector<double>> find_any_stance(const RobotModel& model, double bend,
                                                   double foot_distance) {
  const auto stance = find_stance(model, bend, foot_distance);
  return stance ? stance : find_level_stance(model, bend);
}

void add_posture(const RobotModel& model, const std::string& name, const std::string& family,
                 const std::vector<double>& position, std::ostringstream& text) {
  text << "  - name: " << name << "\n    family: " << family
       << "\n    source: found by nao robot import\n    joints:\n";
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    text << "      " << in_yaml(model.motor_joint(motor).name) << ": " << position[motor] << "\n";
  }
}

}  // namespace

std::string make_structure_text(const RobotModel& model, const RobotStructure& structure,
                                const std::string& urdf) {
  std::ostringstream text = make_stream();
  // Writes the form that RobotModelReader reads.
  const bool has_frame = !structure.frame.matrix().isIdentity(0);
  const std::string root =
      in_yaml(has_frame ? make_free_name(model, "robot_frame") : model.links().front().name);
  text << "urdf: " << urdf << "\n\n"
       << "# Frames of the inertial unit.\n"
       << "inertial_unit: {accelerometer: " << root << ", gyroscope: " << root << "}\n\n"
       << "# Convex outlines of the soles, counter-clockwise from above, in the sole's "
          "frame.\nsoles:\n";
  for (int side = 0; side < 2; ++side) {
    text << (side == 0 ? "  left:\n" : "  right:\n") << "    link: " << make_sole_name(model, side)
         << "\n"
         << "    outline:\n";
    for (const Eigen::Vector2d& corner : structure.soles[side].outline) {
      text << "      - [" << corner.x() << ", " << corner.y() << "]\n";
    }
  }
  std::string sensors;
  for (const FoundSole& sole : structure.soles) {
    for (const int sensor : sole.sensors) {
      sensors += (sensors.empty() ? "" : ", ") + in_yaml(model.links()[sensor].name);
    }
  }
  if (!sensors.empty()) {
    text << "\n# Links of the feet's force sensors.\nfoot_sensors: [" << sensors << "]\n";
  }
  if (!structure.hands.empty()) {
    text << "\n# Links of the hands; the arms are the joints from the root to them.\nhands: {left: "
         << in_yaml(model.links()[structure.hands[0]].name)
         << ", right: " << in_yaml(model.links()[structure.hands[1]].name) << "}\n";
  }
  return text.str();
}

std::string make_sole_links(const RobotModel& model, const RobotStructure& structure) {
  std::ostringstream text = make_stream();
  text.precision(12);
  const auto add_joint = [&](const std::string& name, const std::string& parent,
                             const std::string& child, const Eigen::Isometry3d& pose) {
    std::string in_xml[2];
    TiXmlBase::EncodeString(parent, &in_xml[0]);
    TiXmlBase::EncodeString(child, &in_xml[1]);
    text << "<joint name=\"" << name << "\" type=\"fixed\">\n  <parent link=\"" << in_xml[0]
         << "\"/>\n  <child link=\"" << in_xml[1] << "\"/>\n  <origin xyz=\""
         << to_text(Eigen::Vector3d(pose.translation())) << "\" rpy=\""
         << to_text(to_rpy(pose.linear())) << "\"/>\n</joint>\n";
  };
  if (!structure.frame.matrix().isIdentity(0)) {
    const std::string root = make_free_name(model, "robot_frame");
    text << "<link name=\"" << root << "\"/>\n";
    add_joint(root + "_mount", root, model.links().front().name, structure.frame.inverse());
  }
  for (int side = 0; side < 2; ++side) {
    const FoundSole& sole = structure.soles[side];
    const std::string name = make_sole_name(model, side);
    text << "<link name=\"" << name << "\">";
    if (!sole.has_shape) {
      // A thin plate on the sole, for otherwise nothing carries the robot.
      Eigen::AlignedBox2d box;
      for (const Eigen::Vector2d& corner : sole.outline) box.extend(corner);
      const double thickness = 0.05 * box.sizes().maxCoeff();
      text << "<collision name=\"plate\"><origin xyz=\"" << box.center().x() << " "
           << box.center().y() << " " << 0.5 * thickness << "\"/><geometry><box size=\""
           << box.sizes().x() << " " << box.sizes().y() << " " << thickness
           << "\"/></geometry></collision>";
      if (sole.plate_mass > 0) {
        // A flat box: m / 12 (a^2 + b^2).
        const double x = sole.plate_mass / 12 * std::pow(box.sizes().x(), 2);
        const double y = sole.plate_mass / 12 * std::pow(box.sizes().y(), 2);
        text << "<inertial><mass value=\"" << sole.plate_mass << "\"/><inertia ixx=\"" << y
             << "\" iyy=\"" << x << "\" izz=\"" << x + y
             << "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
      }
    }
    text << "</link>\n";
    add_joint(name + "_mount", model.links()[sole.foot].name, name, sole.pose_in_foot);
  }
  return text.str();
}

std::string make_description_text(const RobotModel& model) {
  std::ostringstream text = make_stream();
  const Symmetry symmetry = find_symmetry(model);
  text << "\n# Mirror images of the joints: poses and keyframes name both joints of a pair by "
          "`name`.\n"
       << "mirrored_joints:\n";
  for (const JointPair& pair : symmetry.pairs) {
    text << "  - {name: " << in_yaml(pair.name)
         << ", left: " << in_yaml(model.motor_joint(pair.left).name);
    if (pair.right >= 0) text << ", right: " << in_yaml(model.motor_joint(pair.right).name);
    text << ", sign: " << symmetry.mirrors[pair.left].sign << "}\n";
  }
  text << "\n# Joints as people name them.\n" << make_groups(model);
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  const double height = -poses[model.left_sole()].translation().z();
  const double width = std::max(kLeastLength, poses[model.left_sole()].translation().y() -
                                                  poses[model.right_sole()].translation().y());
  const auto legs = find_leg_kinematics(model);
  const double length = std::max(kLeastLength, legs ? legs->reach() : height);
  // 0 for a robot that cannot walk.
  const bool walks = legs && legs->roles(Leg::kLeft).ankle_pitch >= 0;
  const double speed = walks ? kFroudeVelocity * std::sqrt(kGravity * length) : 0;
  Kinematics kinematics(model);
  kinematics.update(std::vector<double>(model.num_motors(), 0.0));
  const double center_height =
      kinematics.center_of_mass().z() - kinematics.left_sole().translation().z();
  text << "\n# Servos of the legs, N m/rad: two legs hold " << kPendulumStiffness
       << " m g h.\nmotor_defaults: {least_leg_stiffness: "
       << 0.5 * kPendulumStiffness * model.total_mass() * kGravity * center_height << "}\n";
  text << "\nreference_postures: {ready: ready, stand: zero, rest: crouch}\n"
       << "\n# Bounds of a stance in which a walk can begin, m.\nwalking_stance: {width: ["
       << 0.7 * width << ", " << 1.8 * width << "], greatest_lead: " << 0.25 * length
       << ", least_hip_height: " << 0.6 * length << "}\n"
       << "\n# Slow: v / sqrt(g * leg length) = " << kFroudeVelocity
       << ". nao-walk-tuner finds what the robot sustains.\nwalk_limits: {forward: " << speed
       << ", backward: " << 0.6 * speed << ", sideways: " << 0.5 * speed
       << ", turning: " << (walks ? 0.5 : 0) << "}\n"
       << "\nactions:"
       << (model.legs()[0].joints.empty()
               ? " []\n"
               : "\n  - {name: get-up, does: stand-up}\n  - {name: rest, does: rest}\n");
  return text.str();
}

std::optional<std::vector<double>> find_ready_stance(const RobotModel& model) {
  return find_any_stance(model, kReadyBend, 1);
}

std::string make_postures_text(const RobotModel& model, Findings& findings, double foot_distance) {
  std::ostringstream text = make_stream();
  text.precision(12);
  std::vector<double> zero(model.num_motors(), 0.0);
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    zero[motor] = model.clip_to_limits(motor, 0, zero);
  }
  text << "# Angles of the motors, rad.\npostures:\n";
  const auto add = [&](const std::string& name, const std::string& family, double bend) {
    auto stance = find_any_stance(model, bend, foot_distance);
    // A robot without legs has one stance.
    if (model.legs()[0].joints.empty()) stance = zero;
    if (!stance) {
      findings.push_back({Finding::Severity::kMissing, "postures.yaml", 0, "posture " + name,
                          "the legs do not reach it",
                          "the zero posture takes its place: write its angles by hand"});
    }
    add_posture(model, name, family, stance ? *stance : zero, text);
  };
  add("ready", "standing", kReadyBend);
  add_posture(model, "zero", "standing", zero, text);
  add("crouch", "crouching", kCrouchBend);
  return text.str();
}

}  // namespace nao
