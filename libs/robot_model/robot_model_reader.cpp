#include "robot_model/robot_model_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace nao {
namespace {

Motor read_motor_type(const YamlEntry& entry) {
  entry.allow_only({"continuous_torque", "no_load_velocity", "reflected_inertia", "dry_friction",
                    "viscous_friction", "stiffness_gain", "damping_gain"});
  Motor motor;
  motor.continuous_torque = entry.at("continuous_torque").positive();
  motor.no_load_velocity = entry.at("no_load_velocity").positive();
  motor.reflected_inertia = entry.at("reflected_inertia").not_negative();
  motor.dry_friction = entry.at("dry_friction").not_negative();
  motor.viscous_friction = entry.at("viscous_friction").not_negative();
  motor.stiffness_gain = entry.at("stiffness_gain").positive();
  motor.damping_gain = entry.at("damping_gain").not_negative();
  return motor;
}

// The ranks make left arm, left leg, right leg, right arm: NAO's order of joints.
/** Links at the ends of limbs, and the ranks of the limbs in order_joints(). */
std::map<std::string, int> find_limbs(const YamlEntry& robot) {
  std::map<std::string, int> limbs;
  if (robot.has("hands")) {
    limbs[robot.at("hands").at("left").text()] = 1;
    limbs[robot.at("hands").at("right").text()] = 4;
  }
  limbs[robot.at("soles").at("left").at("link").text()] = 2;
  limbs[robot.at("soles").at("right").at("link").text()] = 3;
  return limbs;
}

}  // namespace

RobotModelReader::RobotModelReader(const std::filesystem::path& folder) {
  model_.folder_ = std::filesystem::absolute(folder).lexically_normal();
}

RobotModel RobotModelReader::read(const std::filesystem::path& folder) {
  RobotModelReader reader(folder);
  const YamlEntry robot = YamlEntry::load(reader.model_.folder_ / "robot.yaml");
  robot.allow_only({"urdf",
                    "motor_types",
                    "motors",
                    "coupled_limits",
                    "joint_groups",
                    "cameras",
                    "inertial_unit",
                    "foot_sensors",
                    "soles",
                    "hands",
                    "mirrored_joints",
                    "motor_defaults",
                    "contact_clusters",
                    "allowed_contacts",
                    "walk_limits",
                    "reference_postures",
                    "heights",
                    "contact_forces",
                    "walking_stance",
                    "walking_arms",
                    "fall_poses",
                    "actions"});
  // A path could lead out of the folder; only a name is allowed.
  const std::string urdf = robot.at("urdf").text();
  if (std::filesystem::path(urdf).filename() != urdf) {
    robot.at("urdf").fail("must be a file in this folder");
  }
  reader.model_.urdf_file_ = reader.model_.folder_ / urdf;
  // The URDF first: all other entries refer to its links and joints by name.
  reader.read_urdf(reader.model_.urdf_file_, find_limbs(robot));
  if (robot.has("motors")) {
    reader.read_motors(robot.at("motor_types"), robot.at("motors"));
  } else {
    reader.estimate_motors(robot);
  }
  if (robot.has("coupled_limits")) reader.read_coupled_limits(robot.at("coupled_limits"));
  if (robot.has("cameras")) reader.read_cameras(robot.at("cameras"));
  reader.read_inertial_unit(robot.at("inertial_unit"));
  reader.read_limbs(robot);
  reader.read_symmetry(robot);
  if (robot.has("joint_groups")) reader.read_joint_groups(robot.at("joint_groups"));
  reader.read_contact_clusters(robot);
  // Postures need coupled limits; reference postures need the postures.
  if (robot.has("actions")) reader.read_actions(robot.at("actions"));
  reader.find_policies();

  const YamlEntry postures = YamlEntry::load(reader.model_.folder_ / "postures.yaml");
  postures.allow_only({"postures"});
  reader.read_postures(postures.at("postures"));
  reader.read_references(robot);
  const std::filesystem::path labels = reader.model_.folder_ / "labels.yaml";
  if (std::filesystem::exists(labels)) reader.read_labels(YamlEntry::load(labels));
  return reader.model_;
}

void RobotModelReader::add_unique(std::set<std::string>& names, const YamlEntry& entry) {
  if (!names.insert(entry.text()).second) {
    entry.fail("\"" + entry.text() + "\" appears twice");
  }
}

int RobotModelReader::motor_named(const YamlEntry& entry) const {
  const int motor = model_.find_motor(entry.text());
  if (motor < 0) {
    entry.fail("\"" + entry.text() + "\" is not a joint with a motor in the URDF");
  }
  return motor;
}

int RobotModelReader::link_named(const YamlEntry& entry) const {
  const int link = model_.find_link(entry.text());
  if (link < 0) {
    entry.fail("\"" + entry.text() + "\" is not a link in the URDF");
  }
  return link;
}

void RobotModelReader::read_motors(const YamlEntry& types, const YamlEntry& motors) {
  std::map<std::string, Motor> motor_types;
  for (const auto& [name, entry] : types.entries()) {
    motor_types[name] = read_motor_type(entry);
  }
  model_.motors_.resize(model_.motor_joints_.size());
  std::vector<bool> is_known(model_.motor_joints_.size(), false);
  for (const auto& [joint, type] : motors.entries()) {
    const int motor = model_.find_motor(joint);
    if (motor < 0) {
      type.fail("is not a joint with a motor in the URDF");
    }
    const auto found = motor_types.find(type.text());
    if (found == motor_types.end()) {
      type.fail("is the unknown motor type \"" + type.text() + "\"");
    }
    model_.motors_[motor] = found->second;
    // Peak torque and velocity are the URDF's, one source for all programs.
    model_.motors_[motor].peak_torque = model_.motor_joint(motor).max_torque;
    if (model_.motors_[motor].peak_torque < model_.motors_[motor].continuous_torque) {
      type.fail("has a continuous torque above the URDF's effort limit");
    }
    is_known[motor] = true;
  }
  // Every motor needs a type: a forgotten one would have no torque.
  for (int motor = 0; motor < model_.num_motors(); ++motor) {
    if (!is_known[motor]) {
      motors.fail("lacks \"" + model_.motor_joint(motor).name + "\"");
    }
  }
}

void RobotModelReader::estimate_motors(const YamlEntry& robot) {
  // Chosen: the ratios of the NAO's leg motors and of published models of humanoids of 30 kg. A
  // motor holds half of its peak torque without a time limit, has no torque at 1.2 times the URDF's
  // velocity, has dry friction of 1.5 % of its peak torque, and its servo reaches the peak torque
  // at an error of 0.1 rad.
  double armature_per_torque = 1e-3;
  double peak_error = 0.1;
  // Least stiffness of the joints that lead to the soles, N m/rad; up to kGreatestStiffening times
  // that by peak_error: stiffer servos shake. Found with ten published robots.
  double least_leg_stiffness = 0;
  constexpr double kGreatestStiffening = 2;
  if (robot.has("motor_defaults")) {
    const YamlEntry defaults = robot.at("motor_defaults");
    defaults.allow_only({"armature_per_torque", "peak_error", "least_leg_stiffness"});
    if (defaults.has("armature_per_torque")) {
      armature_per_torque = defaults.at("armature_per_torque").positive();
    }
    if (defaults.has("peak_error")) peak_error = defaults.at("peak_error").positive();
    if (defaults.has("least_leg_stiffness")) {
      least_leg_stiffness = defaults.at("least_leg_stiffness").not_negative();
    }
  }
  std::set<int> leg_joints;
  for (const char* side : {"left", "right"}) {
    const int sole = link_named(robot.at("soles").at(side).at("link"));
    const std::vector<int> chain = model_.find_chain(sole);
    leg_joints.insert(chain.begin(), chain.end());
  }
  for (int i = 0; i < model_.num_motors(); ++i) {
    const Joint& joint = model_.motor_joint(i);
    Motor motor;
    motor.peak_torque = joint.max_torque;
    motor.continuous_torque = 0.5 * joint.max_torque;
    motor.no_load_velocity = 1.2 * joint.max_velocity;
    motor.reflected_inertia = armature_per_torque * joint.max_torque;
    motor.dry_friction = 0.015 * joint.max_torque;
    motor.viscous_friction = 0.01 * joint.max_torque / motor.no_load_velocity;
    motor.stiffness_gain = joint.max_torque / peak_error;
    if (leg_joints.count(model_.motors()[i]) > 0) {
      motor.stiffness_gain = std::clamp(least_leg_stiffness, motor.stiffness_gain,
                                        kGreatestStiffening * motor.stiffness_gain);
    }
    // Damping ratio 0.9: kd = 2 zeta sqrt(kp J).
    // Nearly critical damping of the rotor alone.
    motor.damping_gain = 1.8 * std::sqrt(motor.stiffness_gain * motor.reflected_inertia);
    model_.motors_.push_back(motor);
  }
}

void RobotModelReader::read_coupled_limits(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    item.allow_only({"joint", "depends_on", "rows"});
    add_unique(names, item.at("joint"));
    CoupledLimit limit;
    limit.motor = motor_named(item.at("joint"));
    limit.other_motor = motor_named(item.at("depends_on"));
    if (limit.motor == limit.other_motor) {
      item.fail("depends on itself");
      // The ranges depend on the other joint's angle: rows of (angle, lower, upper), rad, rising.
    }
    for (const YamlEntry& row : item.at("rows").items()) {
      const std::vector<double> values = row.numbers(3);
      if (!limit.other_position.empty() && values[0] <= limit.other_position.back()) {
        row.fail("must have a larger first number than the row above");
      }
      if (values[1] >= values[2]) {
        row.fail("has its limits reversed");
      }
      const Joint& joint = model_.motor_joint(limit.motor);
      // A row that leaves no part of the joint's own range is a mistake in the file.
      if (values[1] > joint.upper || values[2] < joint.lower) {
        row.fail("is outside the joint's own limits");
      }
      limit.other_position.push_back(values[0]);
      limit.lower.push_back(values[1]);
      limit.upper.push_back(values[2]);
    }
    if (limit.other_position.empty()) {
      item.at("rows").fail("is empty");
    }
    model_.coupled_limits_.push_back(limit);
  }
}

void RobotModelReader::read_cameras(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    item.allow_only({"name", "link", "horizontal_fov", "vertical_fov"});
    add_unique(names, item.at("name"));
    CameraModel camera;
    camera.name = item.at("name").text();
    camera.link = link_named(item.at("link"));
    const auto angle = [&item](const char* key) {
      const double value = item.at(key).positive();
      if (value >= std::numbers::pi) {
        item.at(key).fail("must be below pi");
      }
      return value;
    };
    camera.horizontal_fov = angle("horizontal_fov");
    camera.vertical_fov = angle("vertical_fov");
    model_.cameras_.push_back(camera);
  }
}

void RobotModelReader::read_inertial_unit(const YamlEntry& entry) {
  entry.allow_only({"accelerometer", "gyroscope"});
  model_.accelerometer_ = link_named(entry.at("accelerometer"));
  model_.gyroscope_ = link_named(entry.at("gyroscope"));
}

// Decides which contacts of links do not count as self-collisions: without clusters, those of
// bodies that a joint connects and of the listed pairs; with clusters, all within a cluster and
// between clusters that a joint connects.
void RobotModelReader::read_contact_clusters(const YamlEntry& robot) {
  if (!robot.has("contact_clusters")) {
    // Links behind fixed joints belong to one body.
    std::set<std::pair<int, int>> bodies;
    for (const Joint& joint : model_.joints_) {
      bodies.insert(
          std::minmax(model_.find_body(joint.parent_link), model_.find_body(joint.child_link)));
    }
    if (robot.has("allowed_contacts")) {
      for (const YamlEntry& pair : robot.at("allowed_contacts").items()) {
        const std::vector<YamlEntry> links = pair.items();
        if (links.size() != 2) pair.fail("must be two links");
        bodies.insert(std::minmax(model_.find_body(link_named(links[0])),
                                  model_.find_body(link_named(links[1]))));
      }
    }
    const int count = static_cast<int>(model_.links_.size());
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; b < count; ++b) {
        if (bodies.count(std::minmax(model_.find_body(a), model_.find_body(b))) > 0) {
          model_.allowed_contacts_.emplace_back(a, b);
        }
      }
    }
    return;
  }
  if (robot.has("allowed_contacts")) {
    robot.at("allowed_contacts").fail("must not be there besides `contact_clusters`");
  }
  const YamlEntry list = robot.at("contact_clusters");
  constexpr int kNone = -1;
  std::vector<int> cluster_of(model_.links_.size(), kNone);
  int num_clusters = 0;
  for (const YamlEntry& cluster : list.items()) {
    for (const YamlEntry& item : cluster.items()) {
      int& of_link = cluster_of[link_named(item)];
      if (of_link != kNone) {
        item.fail("\"" + item.text() + "\" appears twice");
      }
      of_link = num_clusters;
    }
    ++num_clusters;
  }
  // Clusters that a joint connects.
  std::set<std::pair<int, int>> neighbors;
  for (const Joint& joint : model_.joints_) {
    // Includes kNone, which no pair below has.
    neighbors.insert(std::minmax(cluster_of[joint.parent_link], cluster_of[joint.child_link]));
  }
  const int num_links = static_cast<int>(model_.links_.size());
  for (int a = 0; a < num_links; ++a) {
    for (int b = a + 1; b < num_links; ++b) {
      if (cluster_of[a] == kNone || cluster_of[b] == kNone) {
        continue;
      }
      if (cluster_of[a] == cluster_of[b] ||
          neighbors.count(std::minmax(cluster_of[a], cluster_of[b])) > 0) {
        model_.allowed_contacts_.emplace_back(a, b);
      }
    }
  }
}

}  // namespace nao
