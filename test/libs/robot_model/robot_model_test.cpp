#include "robot_model/robot_model.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "test/libs/robot_model/nao_robot.h"

namespace nao {
namespace {

TEST(RobotModel, WeighsWhatTheVendorPublishes) {
  EXPECT_NEAR(nao_robot().total_mass(), 5.30535, 1e-8);
}

TEST(RobotModel, HasTwentyFiveMotorsInTheUrdfsOrder) {
  const RobotModel& robot = nao_robot();
  std::vector<std::string> names;
  for (int motor = 0; motor < robot.num_motors(); ++motor) {
    names.push_back(robot.motor_joint(motor).name);
  }
  EXPECT_THAT(names, testing::ElementsAre(
                         "HeadYaw", "HeadPitch", "LShoulderPitch", "LShoulderRoll", "LElbowYaw",
                         "LElbowRoll", "LWristYaw", "LHand", "LHipYawPitch", "LHipRoll",
                         "LHipPitch", "LKneePitch", "LAnklePitch", "LAnkleRoll", "RHipRoll",
                         "RHipPitch", "RKneePitch", "RAnklePitch", "RAnkleRoll", "RShoulderPitch",
                         "RShoulderRoll", "RElbowYaw", "RElbowRoll", "RWristYaw", "RHand"));
}

TEST(RobotModel, ListsParentsBeforeChildren) {
  const RobotModel& robot = nao_robot();
  EXPECT_EQ(robot.links().front().name, "torso");
  EXPECT_EQ(robot.links().front().parent_joint, -1);
  for (size_t i = 0; i < robot.joints().size(); ++i) {
    const Joint& joint = robot.joints()[i];
    EXPECT_LT(joint.parent_link, joint.child_link) << joint.name;
    EXPECT_EQ(robot.links()[joint.child_link].parent_joint, static_cast<int>(i)) << joint.name;
  }
}

TEST(RobotModel, StandsAThirdOfAMetreOverItsSoles) {
  EXPECT_NEAR(pose_of("LSole", zero_posture()).translation().z(), -0.33309, kExact);
  EXPECT_NEAR(pose_of("RSole", zero_posture()).translation().z(), -0.33309, kExact);
}

TEST(RobotModel, HasItsCamerasAtTheirPublishedHeights) {
  const double sole = pose_of("LSole", zero_posture()).translation().z();
  EXPECT_NEAR(pose_of("CameraTop", zero_posture()).translation().z() - sole, 0.5232, 1e-4);
  EXPECT_NEAR(pose_of("CameraBottom", zero_posture()).translation().z() - sole, 0.4773, 1e-4);
}

TEST(RobotModel, LooksAheadAndDownWithItsCameras) {
  const RobotModel& robot = nao_robot();
  ASSERT_EQ(robot.cameras().size(), 2u);
  for (const CameraModel& camera : robot.cameras()) {
    const Eigen::Vector3d view =
        robot.link_poses(zero_posture())[camera.link].linear() * Eigen::Vector3d::UnitX();
    const double published_deg = camera.name == "top" ? 1.2 : 39.7;
    EXPECT_NEAR(std::asin(-view.z()) * 180 / std::numbers::pi, published_deg, 0.05);
    // V5: 60.9 x 47.6 degrees on square pixels, 4:3.
    EXPECT_NEAR(std::tan(camera.horizontal_fov / 2) / std::tan(camera.vertical_fov / 2), 4.0 / 3,
                1e-3);
  }
}

TEST(RobotModel, IsAMirrorImageInItsLinks) {
  const RobotModel& robot = nao_robot();
  for (const Link& link : robot.links()) {
    const int index = robot.find_link(counterpart(link.name));
    ASSERT_GE(index, 0) << link.name;
    const Link& other = robot.links()[index];
    EXPECT_EQ(link.mass, other.mass) << link.name;
    EXPECT_TRUE(link.center_of_mass.isApprox(kMirror * other.center_of_mass)) << link.name;
    EXPECT_TRUE(link.inertia.isApprox(kMirror * other.inertia * kMirror)) << link.name;
    ASSERT_EQ(link.collisions.size(), other.collisions.size()) << link.name;
    for (size_t i = 0; i < link.collisions.size(); ++i) {
      const Shape& shape = link.collisions[i];
      const Shape& twin = other.collisions[i];
      EXPECT_EQ(shape.kind, twin.kind) << link.name;
      EXPECT_EQ(shape.size, twin.size) << link.name;
      EXPECT_EQ(shape.radius, twin.radius) << link.name;
      EXPECT_EQ(shape.length, twin.length) << link.name;
      const Eigen::Isometry3d mirror = mirrored(twin.pose_in_link);
      EXPECT_LT((shape.pose_in_link.translation() - mirror.translation()).norm(), kExact)
          << link.name;
      // Cylinders and capsules only have an axis, which has no sign.
      const double along = shape.pose_in_link.linear().col(2).dot(mirror.linear().col(2));
      EXPECT_NEAR(std::abs(along), 1, 1e-8) << link.name;
    }
  }
}

TEST(RobotModel, IsAMirrorImageInItsJoints) {
  const RobotModel& robot = nao_robot();
  for (const Joint& joint : robot.joints()) {
    if (joint.kind != Joint::Kind::kRevolute) {
      continue;
    }
    const Joint& other = robot.joints()[robot.find_joint(counterpart(joint.name))];
    // A rotation axis is a pseudovector: mirroring at the xz plane keeps y and negates x and z. A
    // joint whose axis is the negative of the mirrored one has a mirrored range.
    const Eigen::Vector3d mirror_axis(-other.axis.x(), other.axis.y(), -other.axis.z());
    const double sign = joint.axis.dot(mirror_axis);
    EXPECT_NEAR(std::abs(sign), 1, 1e-12) << joint.name;
    EXPECT_NEAR(joint.lower, sign > 0 ? other.lower : -other.upper, kExact) << joint.name;
    EXPECT_NEAR(joint.upper, sign > 0 ? other.upper : -other.lower, kExact) << joint.name;
    EXPECT_EQ(joint.max_velocity, other.max_velocity) << joint.name;
    EXPECT_EQ(joint.max_torque, other.max_torque) << joint.name;
    EXPECT_TRUE(joint.pose_in_parent.isApprox(mirrored(other.pose_in_parent))) << joint.name;
  }
}

TEST(RobotModel, IsAMirrorImageInItsFrames) {
  const RobotModel& robot = nao_robot();
  const auto poses = robot.link_poses(zero_posture());
  for (const Link& link : robot.links()) {
    // The real robot's inertial unit and chest button are not on its plane of symmetry.
    if (link.name == "Accelerometer" || link.name == "Gyrometer" || link.name == "ChestButton" ||
        link.name.find("HandTouch") != std::string::npos) {
      continue;
    }
    const Eigen::Isometry3d other = mirrored(poses[robot.find_link(counterpart(link.name))]);
    const Eigen::Isometry3d& pose = poses[robot.find_link(link.name)];
    EXPECT_LT((pose.matrix() - other.matrix()).norm(), kExact) << link.name;
  }
}

TEST(RobotModel, HasMirroredSolesWithTheFootSensorsInside) {
  const RobotModel& robot = nao_robot();
  const auto& left = robot.left_sole_outline();
  const auto& right = robot.right_sole_outline();
  ASSERT_EQ(left.size(), right.size());
  for (size_t i = 0; i < left.size(); ++i) {
    const Eigen::Vector2d& twin = right[right.size() - 1 - i];
    EXPECT_EQ(left[i], Eigen::Vector2d(twin.x(), -twin.y()));
  }
  ASSERT_EQ(robot.foot_sensors().size(), 8u);
  const auto poses = robot.link_poses(zero_posture());
  for (size_t i = 0; i < 8; ++i) {
    const bool is_left = i < 4;
    const Eigen::Vector3d point =
        poses[is_left ? robot.left_sole() : robot.right_sole()].inverse() *
        poses[robot.foot_sensors()[i]].translation();
    EXPECT_NEAR(point.z(), 0, kExact);
    const auto& outline = is_left ? left : right;
    for (size_t k = 0; k < outline.size(); ++k) {
      const Eigen::Vector2d edge = outline[(k + 1) % outline.size()] - outline[k];
      const Eigen::Vector2d to_point = point.head<2>() - outline[k];
      EXPECT_GT(edge.x() * to_point.y() - edge.y() * to_point.x(), 0) << "sensor " << i;
    }
  }
}

TEST(RobotModel, AssignsTheForceSensorsToTheirFeet) {
  EXPECT_THAT(nao_robot().legs()[0].sensors, testing::ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(nao_robot().legs()[1].sensors, testing::ElementsAre(4, 5, 6, 7));
}

/** Names of joints. */
std::vector<std::string> names_of(const std::vector<int>& joints) {
  std::vector<std::string> names;
  for (const int joint : joints) names.push_back(nao_robot().joints()[joint].name);
  return names;
}

TEST(RobotModel, FindsLegsAndArmsAsChainsFromTheRoot) {
  EXPECT_THAT(names_of(nao_robot().legs()[1].joints),
              testing::ElementsAre("RHipYawPitch", "RHipRoll", "RHipPitch", "RKneePitch",
                                   "RAnklePitch", "RAnkleRoll"));
  ASSERT_EQ(nao_robot().arms().size(), 2u);
  EXPECT_THAT(names_of(nao_robot().arms()[0].joints),
              testing::ElementsAre("LShoulderPitch", "LShoulderRoll", "LElbowYaw", "LElbowRoll",
                                   "LWristYaw"));
  // The mimic joint has the motor that it follows.
  EXPECT_EQ(nao_robot().motor_of(nao_robot().legs()[1].joints[0]),
            nao_robot().find_motor("LHipYawPitch"));
}

TEST(RobotModel, NamesBothJointsOfAMirroredPair) {
  const Symmetry& symmetry = nao_robot().symmetry();
  const JointPair* roll = symmetry.find_pair("HipRoll");
  ASSERT_NE(roll, nullptr);
  EXPECT_EQ(roll->left, nao_robot().find_motor("LHipRoll"));
  EXPECT_EQ(roll->right, nao_robot().find_motor("RHipRoll"));
  EXPECT_EQ(symmetry.mirrors[roll->left].motor, roll->right);
  EXPECT_EQ(symmetry.mirrors[roll->right].motor, roll->left);
  EXPECT_EQ(symmetry.mirrors[roll->left].sign, -1);
  EXPECT_EQ(symmetry.find_pair("LHipRoll"), nullptr);
}

TEST(RobotModel, HasReferencePosturesAndActions) {
  EXPECT_EQ(nao_robot().ready_posture().name, "StandInit");
  EXPECT_EQ(nao_robot().references().rest, "Crouch");
  EXPECT_EQ(nao_robot().find_action(Action::Kind::kKick, Side::kRight)->name, "kick-right");
  EXPECT_EQ(nao_robot().find_action(Action::Kind::kKick), nullptr);
  EXPECT_EQ(nao_robot().find_action("wave")->kind, Action::Kind::kGesture);
}

TEST(RobotModel, MovesBothHipsWithOneMotor) {
  const RobotModel& robot = nao_robot();
  std::vector<double> position = zero_posture();
  position[robot.find_motor("LHipYawPitch")] = -0.4;
  const std::vector<double> angles = robot.joint_positions(position);
  EXPECT_EQ(robot.find_motor("RHipYawPitch"), -1);
  EXPECT_EQ(angles[robot.find_joint("LHipYawPitch")], -0.4);
  EXPECT_EQ(angles[robot.find_joint("RHipYawPitch")], -0.4);
  // Negative: legs ahead and toes out.
  const Eigen::Isometry3d sole = pose_of("LSole", position);
  EXPECT_GT(sole.translation().x(), 0.05);
  EXPECT_GT(std::atan2(sole.linear()(1, 0), sole.linear()(0, 0)), 0.1);
}

TEST(RobotModel, HasNaoqisSignOfEachJoint) {
  const RobotModel& robot = nao_robot();
  const auto moved = [&robot](const char* joint, double angle, const char* link) {
    std::vector<double> position = zero_posture();
    position[robot.find_motor(joint)] = angle;
    return Eigen::Vector3d(pose_of(link, position).translation() -
                           pose_of(link, zero_posture()).translation());
  };
  EXPECT_GT(moved("LHipPitch", -0.5, "LSole").x(), 0.05) << "negative hip pitch: leg ahead";
  EXPECT_GT(moved("LHipRoll", 0.3, "LSole").y(), 0.05) << "positive left hip roll: leg outwards";
  EXPECT_LT(moved("LKneePitch", 0.5, "LSole").x(), -0.03) << "positive knee: heel to the seat";
  EXPECT_LT(moved("LShoulderPitch", 0.5, "LHandEffector").z(), -0.05) << "positive: arm down";
  EXPECT_GT(moved("LShoulderRoll", 0.5, "LHandEffector").y(), 0.05) << "positive: arm outwards";
  EXPECT_LT(moved("LElbowRoll", -0.5, "LHandEffector").y(), -0.03) << "negative: forearm inwards";
  EXPECT_LT(moved("HeadPitch", 0.3, "CameraTop").z(), -0.01) << "positive: head down";
  EXPECT_GT(moved("HeadYaw", 0.3, "CameraTop").y(), 0.01) << "positive: head to the left";
}

TEST(RobotModel, LiftsTheFingersWhenAHandOpens) {
  std::vector<double> open = zero_posture();
  open[nao_robot().find_motor("LHand")] = 1;
  const Eigen::Isometry3d change =
      pose_of("LFingers", zero_posture()).inverse() * pose_of("LFingers", open);
  EXPECT_GT((change * Eigen::Vector3d::UnitX()).z(), 0.5);
}

TEST(RobotModel, ClipsToTheCoupledLimits) {
  const RobotModel& robot = nao_robot();
  const int yaw = robot.find_motor("HeadYaw");
  const int pitch = robot.find_motor("HeadPitch");
  std::vector<double> position = zero_posture();
  EXPECT_NEAR(robot.clip_to_limits(pitch, 1, position), 0.514872129, kExact) << "the joint's own";
  position[yaw] = 1.526988;
  EXPECT_NEAR(robot.clip_to_limits(pitch, 1, position), 0.200015, kExact) << "a row";
  position[yaw] = (1.526988 + 1.089958) / 2;
  EXPECT_NEAR(robot.clip_to_limits(pitch, 1, position), (0.200015 + 0.300022) / 2, kExact)
      << "between rows";
  EXPECT_EQ(robot.clip_to_limits(pitch, 0.1, position), 0.1) << "inside";
  position[yaw] = -9;
  EXPECT_NEAR(robot.clip_to_limits(pitch, 1, position), 0.330041, kExact) << "beyond the last row";
}

TEST(RobotModel, LeavesEachCoupledJointARange) {
  const RobotModel& robot = nao_robot();
  for (const CoupledLimit& limit : robot.coupled_limits()) {
    const Joint& other = robot.motor_joint(limit.other_motor);
    std::vector<double> position = zero_posture();
    for (int i = 0; i <= 1000; ++i) {
      position[limit.other_motor] = other.lower + (other.upper - other.lower) * i / 1000;
      EXPECT_LT(robot.clip_to_limits(limit.motor, -10, position),
                robot.clip_to_limits(limit.motor, 10, position))
          << other.name << " at " << position[limit.other_motor];
    }
  }
}

TEST(RobotModel, HasEveryMotorInAJointGroup) {
  const RobotModel& robot = nao_robot();
  std::vector<bool> is_grouped(robot.num_motors(), false);
  for (const JointGroup& group : robot.joint_groups()) {
    for (const int motor : {group.yaw_motor, group.pitch_motor, group.roll_motor}) {
      if (motor >= 0) {
        is_grouped[motor] = true;
      }
    }
  }
  EXPECT_THAT(is_grouped, testing::Each(true));
}

TEST(RobotModel, HasMotorDataConsistentWithTheGearRatios) {
  const RobotModel& robot = nao_robot();
  for (int i = 0; i < robot.num_motors(); ++i) {
    const Motor& motor = robot.motor(i);
    const Joint& joint = robot.motor_joint(i);
    EXPECT_GE(motor.peak_torque, motor.continuous_torque) << joint.name;
    // Vendor tables agree to four digits.
    EXPECT_LE(joint.max_velocity, motor.no_load_velocity * 1.0001) << joint.name;
    EXPECT_LT(motor.dry_friction, 0.1 * motor.peak_torque) << joint.name;
    EXPECT_GT(motor.reflected_inertia, 0) << joint.name;
  }
}

TEST(RobotModel, AllowsContactOfNeighborsOnly) {
  const RobotModel& robot = nao_robot();
  const auto is_allowed = [&robot](const char* a, const char* b) {
    const std::pair<int, int> pair = std::minmax({robot.find_link(a), robot.find_link(b)});
    const auto& allowed = robot.allowed_contacts();
    return std::find(allowed.begin(), allowed.end(), pair) != allowed.end();
  };
  EXPECT_TRUE(is_allowed("LShoulder", "LBicep")) << "one shell";
  EXPECT_TRUE(is_allowed("LThigh", "torso")) << "joined through the hip";
  EXPECT_TRUE(is_allowed("Head", "torso"));
  EXPECT_FALSE(is_allowed("LFoot", "RFoot"));
  EXPECT_FALSE(is_allowed("LWrist", "LThigh"));
  EXPECT_FALSE(is_allowed("LWrist", "LBicep"));
  EXPECT_FALSE(is_allowed("LTibia", "RTibia"));
}

TEST(RobotModel, RejectsANumberOfPositionsThatIsNotItsOwn) {
  EXPECT_THROW(nao_robot().link_poses({0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace nao
