#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "robot_model/collision_shape.h"
#include "test/libs/robot_model/nao_robot.h"

namespace nao {
namespace {

TEST(RobotPostures, AreEight) {
  std::vector<std::pair<std::string, std::string>> postures;
  for (const Posture& each : nao_robot().postures()) {
    postures.emplace_back(each.name, each.family);
  }
  using testing::Pair;
  EXPECT_THAT(postures, testing::ElementsAre(
                            Pair("StandZero", "standing"), Pair("StandInit", "standing"),
                            Pair("Stand", "standing"), Pair("Crouch", "crouching"),
                            Pair("Sit", "sitting"), Pair("SitRelax", "sitting"),
                            Pair("LyingBack", "lying-back"), Pair("LyingBelly", "lying-belly")));
  EXPECT_EQ(nao_robot().find_posture("Moonwalk"), nullptr);
}

TEST(RobotPostures, AreWithinOwnAndCoupledLimits) {
  const RobotModel& robot = nao_robot();
  for (const Posture& each : robot.postures()) {
    const std::vector<double> angles = robot.joint_positions(each.position);
    for (size_t i = 0; i < angles.size(); ++i) {
      const Joint& joint = robot.joints()[i];
      EXPECT_GE(angles[i], joint.lower) << each.name << " " << joint.name;
      EXPECT_LE(angles[i], joint.upper) << each.name << " " << joint.name;
    }
    for (const CoupledLimit& limit : robot.coupled_limits()) {
      const double angle = each.position[limit.motor];
      EXPECT_EQ(robot.clip_to_limits(limit.motor, angle, each.position), angle) << each.name;
    }
  }
}

TEST(RobotPostures, AreSymmetric) {
  const RobotModel& robot = nao_robot();
  for (const Posture& each : robot.postures()) {
    const auto poses = robot.link_poses(each.position);
    for (const char* pair : {"Sole", "HandEffector", "Thigh", "ForeArm"}) {
      const Eigen::Isometry3d& left = poses[robot.find_link(std::string("L") + pair)];
      const Eigen::Isometry3d right = mirrored(poses[robot.find_link(std::string("R") + pair)]);
      EXPECT_LT((left.matrix() - right.matrix()).norm(), 1e-3) << each.name << " " << pair;
    }
  }
}

TEST(RobotPostures, HaveParallelSolesWhenUpright) {
  for (const char* name : {"StandZero", "StandInit", "Stand", "Crouch"}) {
    // The robot leans by the angle between torso and sole; both soles share one plane.
    const Eigen::Isometry3d left = pose_of("LSole", posture(name));
    const Eigen::Isometry3d right = pose_of("RSole", posture(name));
    const double tilt = std::acos(std::min(1.0, left.linear().col(2).dot(right.linear().col(2))));
    EXPECT_LT(tilt, 0.01) << name << ": soles parallel";
    EXPECT_NEAR((left.inverse() * right).translation().z(), 0, 0.5e-3) << name;
  }
}

/** Height of the torso's frame over the left sole. */
double torso_height(const std::string& name) {
  return pose_of("LSole", posture(name)).inverse().translation().z();
}

TEST(RobotPostures, HaveThePublishedTorsoHeights) {
  EXPECT_NEAR(torso_height("StandZero"), 0.333, 0.5e-3);
  EXPECT_NEAR(torso_height("StandInit"), 0.320, 0.5e-3);
  EXPECT_NEAR(torso_height("Stand"), 0.3315, 0.5e-3);
  EXPECT_NEAR(torso_height("Crouch"), 0.229, 0.5e-3);
}

/** Self-collisions in a posture: pairs of links, and their overlap, m. */
std::map<std::string, double> overlaps_in(const std::string& name) {
  const RobotModel& robot = nao_robot();
  const auto poses = robot.link_poses(posture(name));
  const auto& allowed = robot.allowed_contacts();
  const auto place = [&](int link, const Shape& shape) {
    // The real shells have radii of 4 mm or more.
    RoundedBox box = rounded_box_in_link(robot.links()[link], shape, 0.004);
    box.center = poses[link] * box.center;
    box.rotation = poses[link].linear() * box.rotation;
    return box;
  };
  std::map<std::string, double> overlaps;
  const int num_links = static_cast<int>(robot.links().size());
  for (int a = 0; a < num_links; ++a) {
    for (int b = a + 1; b < num_links; ++b) {
      if (std::find(allowed.begin(), allowed.end(), std::pair(a, b)) != allowed.end()) {
        continue;
      }
      for (const Shape& shape : robot.links()[a].collisions) {
        for (const Shape& other : robot.links()[b].collisions) {
          const double distance = closest_points(place(a, shape), place(b, other)).distance;
          if (distance < 0) {
            double& overlap = overlaps[robot.links()[a].name + " " + robot.links()[b].name];
            overlap = std::max(overlap, -distance);
          }
        }
      }
    }
  }
  return overlaps;
}

TEST(RobotPostures, HaveNoSelfCollision) {
  for (const char* name :
       {"StandZero", "StandInit", "Stand", "Crouch", "SitRelax", "LyingBack", "LyingBelly"}) {
    EXPECT_THAT(overlaps_in(name), testing::IsEmpty()) << name;
  }
}

TEST(RobotPostures, HaveTheHandsOnTheLegsWhenSitting) {
  // Where the real shells are soft or hollow, the primitives overlap by less than a centimeter.
  for (const auto& [pair, overlap] : overlaps_in("Sit")) {
    EXPECT_THAT(pair, testing::AnyOf(testing::HasSubstr("Wrist"), testing::HasSubstr("ForeArm")));
    EXPECT_LT(overlap, 0.010) << pair;
  }
}

}  // namespace
}  // namespace nao
