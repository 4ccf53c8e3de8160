#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "common/constants.h"
#include "robot_model/action_kinds.h"
#include "robot_model/policy_files.h"
#include "robot_model/robot_model_reader.h"

namespace nao {
namespace {

// Fraction of the standing height above which an upright robot is on its feet, if robot.yaml does
// not state it. Chosen: a NAO stands at 0.32 m, crouches at 0.229 m and sits at 0.12 m.
constexpr double kOnFeetFraction = 0.6;
// The same for contact: fractions of the weight on a foot in contact, and of the difference of
// loads at which the other foot becomes the support foot. Chosen: above the noise of force sensors
// and the error of forces from joint torques.
constexpr double kContactFraction = 0.06;
constexpr double kSupportSwitchFraction = 0.1;

// How far an angle may be outside of a limit that is written with more digits, rad.
constexpr double kLimitTolerance = 1e-9;

Action::Kind read_action_kind(const YamlEntry& entry) {
  const auto found = std::find(kActionKinds.begin(), kActionKinds.end(), entry.text());
  const auto kind = static_cast<Action::Kind>(found - kActionKinds.begin());
  if (kind < Action::Kind::kPolicy) return kind;
  entry.fail("must be stand-up, rest, kick, block, dive or gesture");
}

// A policy that gets up is what `get-up` does, no action of its own.
bool is_get_up(const std::filesystem::path& policy_file) {
  try {
    return YAML::LoadFile(policy_file.string())["kind"].as<std::string>("") == "get-up";
  } catch (const YAML::Exception&) {
    return false;
  }
}

Side read_side(const YamlEntry& entry) {
  if (entry.text() == "left") return Side::kLeft;
  if (entry.text() == "right") return Side::kRight;
  entry.fail("must be left or right");
}

}  // namespace

// Angles of some joints, rad, in motor order; NaN for joints that are not named. A name of
// mirrored_joints sets both sides.
std::vector<double> RobotModelReader::read_pose(const YamlEntry& joints) const {
  std::vector<double> pose(model_.num_motors(), std::numeric_limits<double>::quiet_NaN());
  const auto set = [&](int motor, double angle, const YamlEntry& entry) {
    const Joint& joint = model_.motor_joint(motor);
    if (angle < joint.lower - kLimitTolerance || angle > joint.upper + kLimitTolerance) {
      entry.fail("is outside the limits of " + joint.name);
    }
    pose[motor] = std::clamp(angle, joint.lower, joint.upper);
  };
  for (const auto& [name, entry] : joints.entries()) {
    const double angle = entry.number();
    const int motor = model_.find_motor(name);
    if (motor >= 0) {
      set(motor, angle, entry);
      continue;
    }
    const JointPair* pair = model_.symmetry_.find_pair(name);
    if (pair == nullptr) entry.fail("is neither a joint nor a name in mirrored_joints");
    set(pair->left, angle, entry);
    const MirrorMotor& mirror = model_.symmetry_.mirrors[pair->left];
    set(mirror.motor, mirror.sign * angle, entry);
  }
  return pose;
}

void RobotModelReader::read_references(const YamlEntry& robot) {
  MotionReferences& references = model_.references_;
  if (!model_.postures_.empty()) references.ready = model_.postures_.front().name;
  const auto read_name = [this, &robot](const char* key, const std::string& otherwise) {
    if (!robot.has("reference_postures") || !robot.at("reference_postures").has(key)) {
      return otherwise;
    }
    const YamlEntry entry = robot.at("reference_postures").at(key);
    if (model_.find_posture(entry.text()) == nullptr) entry.fail("is not a posture");
    return entry.text();
  };
  if (robot.has("reference_postures")) {
    robot.at("reference_postures").allow_only({"ready", "stand", "rest"});
  }
  references.ready = read_name("ready", references.ready);
  references.stand = read_name("stand", references.ready);
  references.rest = read_name("rest", references.ready);

  // A fall without poses leaves all joints where they are.
  const std::vector<double> free(model_.num_motors(), std::numeric_limits<double>::quiet_NaN());
  references.fall = {free, free, free};
  if (robot.has("fall_poses")) {
    const YamlEntry poses = robot.at("fall_poses");
    poses.allow_only({"forward", "backward", "sideways"});
    references.fall.forward = read_pose(poses.at("forward"));
    references.fall.backward = read_pose(poses.at("backward"));
    references.fall.sideways = read_pose(poses.at("sideways"));
  }
  if (robot.has("walking_arms")) read_walking_arms(robot.at("walking_arms"));
  if (robot.has("heights")) {
    read_heights(robot.at("heights"));
  } else if (const Posture* ready = model_.find_posture(references.ready); ready != nullptr) {
    // Height of the torso over the left sole in the ready posture, m.
    const std::vector<Eigen::Isometry3d> poses = model_.link_poses(ready->position);
    references.heights.standing = poses[model_.left_sole()].inverse().translation().z();
    references.heights.on_feet = kOnFeetFraction * references.heights.standing;
  }
  read_contact_forces(robot);
  if (robot.has("walking_stance")) read_walking_stance(robot.at("walking_stance"));
  if (robot.has("walk_limits")) {
    const YamlEntry limits = robot.at("walk_limits");
    limits.allow_only({"forward", "backward", "sideways", "turning"});
    model_.walk_limits_.forward = limits.at("forward").not_negative();
    model_.walk_limits_.backward = limits.at("backward").not_negative();
    model_.walk_limits_.sideways = limits.at("sideways").not_negative();
    model_.walk_limits_.turning = limits.at("turning").not_negative();
  }
}

void RobotModelReader::read_heights(const YamlEntry& entry) {
  entry.allow_only({"standing", "on_feet"});
  BodyHeights& heights = model_.references_.heights;
  heights.standing = entry.at("standing").positive();
  heights.on_feet = entry.at("on_feet").positive();
  if (heights.on_feet >= heights.standing) entry.at("on_feet").fail("must be below standing");
}

void RobotModelReader::read_contact_forces(const YamlEntry& robot) {
  ContactForces& forces = model_.references_.contact_forces;
  const double weight = model_.total_mass() * kGravity;
  forces = {kContactFraction * weight, kSupportSwitchFraction * weight};
  if (!robot.has("contact_forces")) return;
  const YamlEntry entry = robot.at("contact_forces");
  entry.allow_only({"contact", "support_switch"});
  forces.contact = entry.at("contact").positive();
  forces.support_switch = entry.at("support_switch").positive();
}

void RobotModelReader::read_walking_stance(const YamlEntry& entry) {
  entry.allow_only({"width", "greatest_lead", "least_hip_height"});
  WalkingStance& stance = model_.references_.walking_stance;
  const std::vector<double> width = entry.at("width").numbers(2);
  if (!(width[0] < width[1])) entry.at("width").fail("must rise");
  stance.least_width = width[0];
  stance.greatest_width = width[1];
  stance.greatest_lead = entry.at("greatest_lead").positive();
  stance.least_hip_height = entry.at("least_hip_height").positive();
}

void RobotModelReader::read_walking_arms(const YamlEntry& entry) {
  entry.allow_only({"angles", "swing"});
  const std::vector<double> angles = read_pose(entry.at("angles"));
  std::vector<double> swing(angles.size(), 0.0);
  for (const auto& [name, factor] : entry.at("swing").entries()) {
    const JointPair* pair = model_.symmetry_.find_pair(name);
    if (pair == nullptr || pair->right < 0) factor.fail("is not a pair of mirrored_joints");
    if (std::isnan(angles[pair->left])) factor.fail("has no angle");
    // The arms swing in opposite phases.
    swing[pair->left] = factor.number();
    // Without the minus sign both arms would swing in the same phase in the mirrored sense.
    swing[pair->right] = -model_.symmetry_.mirrors[pair->left].sign * factor.number();
  }
  for (int motor = 0; motor < model_.num_motors(); ++motor) {
    if (std::isnan(angles[motor])) continue;
    model_.references_.walking_arms.push_back({motor, angles[motor], swing[motor]});
  }
}

void RobotModelReader::read_actions(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    item.allow_only({"name", "does", "side", "keyframes"});
    add_unique(names, item.at("name"));
    Action action;
    action.name = item.at("name").text();
    action.kind = read_action_kind(item.at("does"));
    if (item.has("side")) action.side = read_side(item.at("side"));
    const bool has_side = action.kind == Action::Kind::kKick || action.kind == Action::Kind::kDive;
    if (has_side != (action.side != Side::kNone)) {
      item.fail(has_side ? "lacks \"side\": left or right" : "must not have a side");
    }
    action.keyframes = item.has("keyframes") ? item.at("keyframes").text() : action.name;
    model_.actions_.push_back(action);
  }
}

// Their files are read by what runs them: one that is wrong is not a fault of the robot.
void RobotModelReader::find_policies() {
  std::set<std::string> names;
  for (const std::filesystem::path& file : find_policy_files(model_.folder_)) {
    if (!is_get_up(file)) names.insert(file.parent_path().filename().string());
  }
  if (names.empty()) return;
  names.insert(kOwnGaitAction);
  for (const std::string& name : names) {
    if (model_.find_action(name) != nullptr) {
      throw ModelError((model_.folder_ / kPolicyFolder / name).string() +
                       ": is the name of an action of the robot, too");
    }
    const auto kind = name == kOwnGaitAction ? Action::Kind::kOwnGait : Action::Kind::kPolicy;
    model_.actions_.push_back({name, kind, Side::kNone, name});
  }
}

void RobotModelReader::read_labels(const YamlEntry& root) {
  root.allow_only({"postures", "actions", "groups", "cameras"});
  // Labels are texts for people in several languages; a label of an unknown name is a spelling
  // mistake.
  const auto read = [&](const char* key, const char* kind, const auto& items) {
    if (!root.has(key)) return;
    for (const auto& [name, texts] : root.at(key).entries()) {
      const auto& label_name = name;
      const bool is_known = std::any_of(items.begin(), items.end(),
                                        [&](const auto& item) { return item.name == label_name; });
      if (!is_known) texts.fail(std::string("is the name of no ") + kind);
      Label label{kind, name, {}};
      for (const auto& [language, text] : texts.entries()) label.texts[language] = text.text();
      model_.labels_.push_back(label);
    }
  };
  read("postures", "posture", model_.postures_);
  read("actions", "action", model_.actions_);
  read("groups", "group", model_.joint_groups_);
  read("cameras", "camera", model_.cameras_);
}

void RobotModelReader::read_postures(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    item.allow_only({"name", "family", "source", "joints"});
    add_unique(names, item.at("name"));
    Posture posture;
    posture.name = item.at("name").text();
    posture.family = item.at("family").text();
    // Required, and not used: where the angles come from.
    item.at("source").text();
    const std::set<std::string> families = {"standing", "crouching", "sitting", "lying-back",
                                            "lying-belly"};
    if (families.count(posture.family) == 0) {
      item.at("family").fail("\"" + posture.family + "\" is unknown");
    }
    posture.position.assign(model_.motor_joints_.size(), std::nan(""));
    const YamlEntry joints = item.at("joints");
    for (const auto& [joint, angle] : joints.entries()) {
      const int motor = model_.find_motor(joint);
      if (motor < 0) {
        angle.fail("is not a joint with a motor in the URDF");
      }
      posture.position[motor] = angle.number();
    }
    // A posture has all joints, so that it can be reached from anywhere.
    for (int motor = 0; motor < model_.num_motors(); ++motor) {
      if (std::isnan(posture.position[motor])) {
        joints.fail("lacks \"" + model_.motor_joint(motor).name + "\"");
      }
    }
    // Coupled limits need all angles; therefore after the whole posture is read.
    for (int motor = 0; motor < model_.num_motors(); ++motor) {
      double& angle = posture.position[motor];
      const double clipped = model_.clip_to_limits(motor, angle, posture.position);
      if (std::abs(clipped - angle) > kLimitTolerance) {
        joints.at(model_.motor_joint(motor).name).fail("is outside the joint's limits");
      }
      angle = clipped;
    }
    model_.postures_.push_back(posture);
  }
}

}  // namespace nao
