/** docs/joints.md agrees with the robot's files. */

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "common/data_path.h"
#include "robot_model/robot_model.h"

namespace nao {
namespace {

using Row = std::vector<std::string>;

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/** Rows of all tables whose head begins with `first_column`, by their first cell. */
std::map<std::string, Row> read_table(const std::string& first_column) {
  std::ifstream file(std::string(NAO_SOURCE_DIR) + "/docs/joints.md");
  std::map<std::string, Row> rows;
  bool is_inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] != '|') {
      is_inside = false;
      continue;
    }
    Row row;
    std::stringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');) {
      row.push_back(trimmed(cell));
    }
    if (is_inside && row[0] != "---") {
      rows[row[0]] = row;
    }
    is_inside = is_inside || row[0] == first_column;
  }
  return rows;
}

std::string axis_in_words(const Eigen::Vector3d& axis) {
  std::string words;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(axis(i)) > 1e-6) {
      words += axis(i) < 0 ? "-" : words.empty() ? "" : "+";
      words += "xyz"[i];
    }
  }
  return words;
}

TEST(RobotDocs, ListEveryJointAsTheUrdfHasIt) {
  const RobotModel robot = RobotModel::load(data_path() / "robots" / "nao");
  std::map<std::string, Row> rows = read_table("Joint");
  for (const Joint& joint : robot.joints()) {
    if (joint.kind != Joint::Kind::kRevolute) {
      continue;
    }
    ASSERT_EQ(rows.count(joint.name), 1u) << joint.name;
    const Row& row = rows[joint.name];
    ASSERT_EQ(row.size(), 8u) << joint.name;
    EXPECT_EQ(row[1], robot.links()[joint.child_link].name) << joint.name;
    EXPECT_EQ(row[2], axis_in_words(joint.axis)) << joint.name;
    // Four and three decimals.
    EXPECT_NEAR(std::stod(row[3]), joint.lower, 0.5001e-4) << joint.name;
    EXPECT_NEAR(std::stod(row[4]), joint.upper, 0.5001e-4) << joint.name;
    EXPECT_NEAR(std::stod(row[5]), joint.max_velocity, 0.5001e-3) << joint.name;
    EXPECT_NEAR(std::stod(row[6]), joint.max_torque, 0.5001e-3) << joint.name;
    rows.erase(joint.name);
  }
  EXPECT_THAT(rows, testing::IsEmpty());
}

TEST(RobotDocs, ListEveryMotorAsRobotYamlHasIt) {
  const RobotModel robot = RobotModel::load(data_path() / "robots" / "nao");
  const std::map<std::string, Row> joints = read_table("Joint");
  const std::map<std::string, Row> motors = read_table("Motor");
  EXPECT_EQ(motors.size(), 7u);
  for (int i = 0; i < robot.num_motors(); ++i) {
    const std::string& joint = robot.motor_joint(i).name;
    const auto found = motors.find(joints.at(joint)[7]);
    ASSERT_NE(found, motors.end()) << joint;
    const Row& row = found->second;
    const Motor& motor = robot.motor(i);
    const std::vector<double> values = {motor.continuous_torque, motor.no_load_velocity,
                                        motor.reflected_inertia, motor.dry_friction,
                                        motor.viscous_friction,  motor.stiffness_gain,
                                        motor.damping_gain};
    ASSERT_EQ(row.size(), values.size() + 2) << row[0];
    for (size_t k = 0; k < values.size(); ++k) {
      EXPECT_DOUBLE_EQ(std::stod(row[k + 2]), values[k]) << row[0] << " column " << k + 2;
    }
  }
}

}  // namespace
}  // namespace nao
