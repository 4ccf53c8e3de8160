#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "robot_model/robot_model_reader.h"

namespace nao {
namespace {

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
    // Exterior angle at the corner, rad, positive for a left turn.
    const double turn =
        std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    if (turn <= 0) {
      list.fail("is not convex and counter-clockwise at point " + std::to_string((i + 1) % count));
    }
    sum += turn;
  }
  // A star polygon has left turns only as well, but goes around twice.
  if (sum > 2 * std::numbers::pi + 1e-6) {
    list.fail("goes around more than once");
  }
  return outline;
}

}  // namespace

void RobotModelReader::read_limbs(const YamlEntry& robot) {
  const YamlEntry soles = robot.at("soles");
  soles.allow_only({"left", "right"});
  read_sole(soles.at("left"), model_.legs_[0]);
  read_sole(soles.at("right"), model_.legs_[1]);
  if (robot.has("foot_sensors")) read_foot_sensors(robot.at("foot_sensors"));
  if (!robot.has("hands")) return;
  robot.at("hands").allow_only({"left", "right"});
  for (const char* side : {"left", "right"}) {
    ArmDescription arm;
    arm.hand = link_named(robot.at("hands").at(side));
    // Joints from the torso to the hand, without fixed ones.
    arm.joints = model_.find_chain(arm.hand);
    model_.arms_.push_back(arm);
  }
}

void RobotModelReader::read_sole(const YamlEntry& entry, LegDescription& leg) {
  entry.allow_only({"link", "outline"});
  leg.sole = link_named(entry.at("link"));
  leg.outline = read_outline(entry.at("outline"));
  leg.joints = model_.find_chain(leg.sole);
}

void RobotModelReader::read_foot_sensors(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    add_unique(names, item);
    const int link = link_named(item);
    const int body = model_.find_body(link);
    // Sensors belong to the leg whose sole is fixed to the same body.
    const auto leg = std::find_if(
        model_.legs_.begin(), model_.legs_.end(),
        [&](const LegDescription& candidate) { return model_.find_body(candidate.sole) == body; });
    if (leg == model_.legs_.end()) item.fail("is not fixed to the link of a sole");
    leg->sensors.push_back(static_cast<int>(model_.foot_sensors_.size()));
    model_.foot_sensors_.push_back(link);
  }
}

void RobotModelReader::read_symmetry(const YamlEntry& robot) {
  Symmetry& symmetry = model_.symmetry_;
  // Without an entry a motor is its own mirror image.
  for (int motor = 0; motor < model_.num_motors(); ++motor) symmetry.mirrors.push_back({motor, 1});
  if (!robot.has("mirrored_joints")) return;
  std::set<std::string> names;
  std::set<int> known;
  for (const YamlEntry& item : robot.at("mirrored_joints").items()) {
    item.allow_only({"name", "left", "right", "sign"});
    add_unique(names, item.at("name"));
    JointPair pair;
    pair.name = item.at("name").text();
    pair.left = motor_named(item.at("left"));
    if (item.has("right")) pair.right = motor_named(item.at("right"));
    if (pair.right == pair.left) item.at("right").fail("is the left joint, too");
    const double sign = item.at("sign").number();
    if (std::abs(sign) != 1) item.at("sign").fail("must be 1 or -1");
    // A joint in the middle (HeadYaw) has no partner: it mirrors onto itself, with its sign.
    const int other = pair.right >= 0 ? pair.right : pair.left;
    // A set, since both may be the same motor.
    for (const int motor : std::set<int>{pair.left, other}) {
      if (!known.insert(motor).second) item.fail("has a joint that appears twice");
    }
    // A pair's name must not hide another joint; a joint without a partner may have its own name.
    const int named = model_.find_motor(pair.name);
    if (named >= 0 && (named != pair.left || pair.right >= 0)) {
      item.at("name").fail("is the name of a joint");
    }
    symmetry.mirrors[pair.left] = {other, sign};
    symmetry.mirrors[other] = {pair.left, sign};
    symmetry.pairs.push_back(pair);
  }
}

void RobotModelReader::read_joint_groups(const YamlEntry& list) {
  std::set<std::string> names;
  for (const YamlEntry& item : list.items()) {
    item.allow_only({"name", "yaw", "pitch", "roll", "opening"});
    add_unique(names, item.at("name"));
    JointGroup group;
    group.name = item.at("name").text();
    const auto motor_of = [this, &item](const char* axis) {
      return item.has(axis) ? motor_named(item.at(axis)) : -1;
    };
    group.yaw_motor = motor_of("yaw");
    group.pitch_motor = motor_of("pitch");
    group.roll_motor = motor_of("roll");
    if (item.has("opening")) {
      // An opening is shown in the place of the pitch.
      if (item.has("pitch")) item.fail("has both a pitch and an opening");
      group.pitch_motor = motor_of("opening");
      group.is_opening = true;
    }
    if (std::max({group.yaw_motor, group.pitch_motor, group.roll_motor}) < 0) {
      item.fail("has no joint");
    }
    model_.joint_groups_.push_back(group);
  }
}

}  // namespace nao
