#include "robot_model/robot_model_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace nao {
namespace {

/** Adds a name. @throws ModelError  if it is known already. */
void add_unique(std::set<std::string>& names, const YamlEntry& entry) {
  if (!names.insert(entry.text()).second) {
    entry.fail("\"" + entry.text() + "\" appears twice");
  }
}

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

/** @throws ModelError  unless the points are the corners of a convex polygon, counter-clockwise. */
std::vector<Eigen::Vector2d> read_outline(const YamlEntry& list) {
  std::vector<Eigen::Vector2d> outline;
  for (const YamlEntry& item : list.items()) {
    const std::vector<double> point = item.numbers(2);
    outline.emplace_back(point[0], point[1]);
  }
  if (outline.size() < 3) {
    list.fail("has fewer than three points");
  }
  const size_t count = outline.size();
  // All exterior angles of a convex polygon have one sign; their sum is a full turn.
  double sum = 0;
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d before = outline[(i + 1) % count] - outline[i];
    const Eigen::Vector2d after = outline[(i + 2) % count] - outline[(i + 1) % count];
    const double turn =
        std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    if (turn <= 0) {
      list.fail("is not convex and counter-clockwise at point " + std::to_string((i + 1) % count));
    }
    sum += turn;
  }
  if (sum > 2 * std::numbers::pi + 1e-6) {
    list.fail("goes around more than once");
  }
  return outline;
}

}  // namespace

RobotModelReader::RobotModelReader(const std::filesystem::path& folder) {
  model_.folder_ = std::filesystem::absolute(folder).lexically_normal();
}

RobotModel RobotModelReader::read(const std::filesystem::path& folder) {
  RobotModelReader reader(folder);
  const YamlEntry robot = YamlEntry::load(reader.model_.folder_ / "robot.yaml");
  robot.allow_only({"urdf", "motor_types", "motors", "coupled_limits", "joint_groups", "cameras",
                    "inertial_unit", "foot_sensors", "soles", "contact_clusters", "walk_limits",
                    "actions"});
  const std::string urdf = robot.at("urdf").text();
  if (std::filesystem::path(urdf).filename() != urdf) {
    robot.at("urdf").fail("must be a file in this folder");
  }
  reader.model_.urdf_file_ = reader.model_.folder_ / urdf;
  reader.read_urdf(reader.model_.urdf_file_);
  reader.read_motors(robot.at("motor_types"), robot.at("motors"));
  reader.read_coupled_limits(robot.at("coupled_limits"));
  reader.read_joint_groups(robot.at("joint_groups"));
  reader.read_cameras(robot.at("cameras"));
  reader.read_inertial_unit(robot.at("inertial_unit"));
  reader.read_foot_sensors(robot.at("foot_sensors"));
  reader.read_soles(robot.at("soles"));
  reader.assign_foot_sensors(robot.at("foot_sensors"));
  reader.read_contact_clusters(robot.at("contact_clusters"));
  reader.read_walk_limits(robot.at("walk_limits"));
  reader.read_actions(robot.at("actions"));

  const YamlEntry postures = YamlEntry::load(reader.model_.folder_ / "postures.yaml");
  postures.allow_only({"postures"});
  reader.read_postures(postures.at("postures"));
  return reader.model_;
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
    model_.motors_[motor].peak_torque = model_.motor_joint(motor).max_torque;
    if (model_.motors_[motor].peak_torque < model_.motors_[motor].continuous_torque) {
      type.fail("has a continuous torque above the URDF's effort limit");
    }
    is_known[motor] = true;
  }
  for (int motor = 0; motor < model_.num_motors(); ++motor) {
    if (!is_known[motor]) {
      motors.fail("lacks \"" + model_.motor_joint(motor).name + "\"");
    }
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

void RobotModelReader::read_joint_groups(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    item.allow_only({"name", "yaw", "pitch", "roll"});
    add_unique(names, item.at("name"));
    JointGroup group;
    group.name = item.at("name").text();
    const auto motor_of = [this, &item](const char* axis) {
      return item.has(axis) ? motor_named(item.at(axis)) : -1;
    };
    group.yaw_motor = motor_of("yaw");
    group.pitch_motor = motor_of("pitch");
    group.roll_motor = motor_of("roll");
    if (std::max({group.yaw_motor, group.pitch_motor, group.roll_motor}) < 0) {
      item.fail("has no joint");
    }
    model_.joint_groups_.push_back(group);
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

void RobotModelReader::read_foot_sensors(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    add_unique(names, item);
    model_.foot_sensors_.push_back(link_named(item));
  }
}

void RobotModelReader::read_soles(const YamlEntry& entry) {
  entry.allow_only({"left", "right"});
  const auto read_sole = [this](const YamlEntry& sole, int& link,
                                std::vector<Eigen::Vector2d>& outline) {
    sole.allow_only({"link", "outline"});
    link = link_named(sole.at("link"));
    outline = read_outline(sole.at("outline"));
  };
  read_sole(entry.at("left"), model_.feet_[0].sole, model_.feet_[0].outline);
  read_sole(entry.at("right"), model_.feet_[1].sole, model_.feet_[1].outline);
}

void RobotModelReader::assign_foot_sensors(const YamlEntry& list) {
  // The first link of the rigid body that a link belongs to.
  const auto body_of = [this](int link) {
    int joint = model_.links_[link].parent_joint;
    while (joint >= 0 && model_.joints_[joint].kind == Joint::Kind::kFixed) {
      link = model_.joints_[joint].parent_link;
      joint = model_.links_[link].parent_joint;
    }
    return link;
  };
  for (size_t i = 0; i < model_.foot_sensors_.size(); ++i) {
    const int body = body_of(model_.foot_sensors_[i]);
    const auto foot =
        std::find_if(model_.feet_.begin(), model_.feet_.end(),
                     [&](const Foot& candidate) { return body_of(candidate.sole) == body; });
    if (foot == model_.feet_.end()) {
      list.items()[i].fail("is not fixed to the link of a sole");
    }
    foot->sensors.push_back(static_cast<int>(i));
  }
}

void RobotModelReader::read_contact_clusters(const YamlEntry& list) {
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

void RobotModelReader::read_walk_limits(const YamlEntry& entry) {
  entry.allow_only({"forward", "backward", "sideways", "turning"});
  model_.walk_limits_.forward = entry.at("forward").not_negative();
  model_.walk_limits_.backward = entry.at("backward").not_negative();
  model_.walk_limits_.sideways = entry.at("sideways").not_negative();
  model_.walk_limits_.turning = entry.at("turning").not_negative();
}

void RobotModelReader::read_actions(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    add_unique(names, item);
    model_.actions_.push_back(item.text());
  }
}

void RobotModelReader::read_postures(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    item.allow_only({"name", "family", "source", "joints"});
    add_unique(names, item.at("name"));
    Posture posture;
    posture.name = item.at("name").text();
    posture.family = item.at("family").text();
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
    for (int motor = 0; motor < model_.num_motors(); ++motor) {
      if (std::isnan(posture.position[motor])) {
        joints.fail("lacks \"" + model_.motor_joint(motor).name + "\"");
      }
    }
    for (int motor = 0; motor < model_.num_motors(); ++motor) {
      const double angle = posture.position[motor];
      if (model_.clip_to_limits(motor, angle, posture.position) != angle) {
        joints.at(model_.motor_joint(motor).name).fail("is outside the joint's limits");
      }
    }
    model_.postures_.push_back(posture);
  }
}

}  // namespace nao
