#include "tools/vision-dataset/scene_objects.h"

#include <algorithm>
#include <cmath>

namespace nao::vision {

Eigen::Vector3f random_color(Random& random, double lower, double upper) {
  return {static_cast<float>(random.uniform(lower, upper)),
          static_cast<float>(random.uniform(lower, upper)),
          static_cast<float>(random.uniform(lower, upper))};
}

void add_box(RandomScene& scene, const Eigen::Vector3d& center, double yaw,
             const Eigen::Vector3d& size, const Eigen::Vector3f& color) {
  Distractor box;
  box.pose_in_world.translation() = center;
  box.pose_in_world.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).matrix();
  box.size = size;
  box.color = color;
  scene.distractors.push_back(box);
}

void add_person(RandomScene& scene, const Eigen::Vector2d& place, Random& random) {
  const double yaw = random.uniform(0, 2 * M_PI);
  const Eigen::Vector3f trousers = random_color(random, 0.01, 0.4);
  const Eigen::Vector3f shoes = random_color(random, 0.01, 0.8);
  const Eigen::Vector2d side(-std::sin(yaw), std::cos(yaw));
  for (const double sign : {-1.0, 1.0}) {
    const Eigen::Vector2d foot = place + sign * 0.12 * side;
    Distractor leg;
    leg.kind = Distractor::Kind::kCylinder;
    leg.pose_in_world.translation() << foot.x(), foot.y(), 0.45;
    leg.size = {0.13, 0.13, 0.9};
    leg.color = trousers;
    scene.distractors.push_back(leg);
    add_box(scene, {foot.x() + 0.06 * std::cos(yaw), foot.y() + 0.06 * std::sin(yaw), 0.04}, yaw,
            {0.28, 0.1, 0.08}, shoes);
  }
  add_box(scene, {place.x(), place.y(), 1.2}, yaw, {0.25, 0.45, 0.6},
          random_color(random, 0.02, 0.8));
}

PlacedRobot place_robot(const RobotModel& model, const Eigen::Vector2d& place, Random& random) {
  PlacedRobot robot;
  const auto& postures = model.postures();
  std::vector<const Posture*> standing;
  for (const Posture& posture : postures) {
    if (posture.family == "standing" || posture.family == "crouching") standing.push_back(&posture);
  }
  const Posture& posture = *standing[random.next() % standing.size()];
  robot.position = posture.position;
  for (double& angle : robot.position) angle += 0.06 * random.normal();
  robot.place = place;
  // Shirts, dirt and other makes.
  const double shade = random.uniform(0.5, 1);
  for (float& value : robot.tint) value = static_cast<float>(shade * random.uniform(0.85, 1));
  const auto links = model.link_poses(robot.position);
  const double sole = std::min(links[model.left_sole()].translation().z(),
                               links[model.right_sole()].translation().z());
  robot.pose_torso_in_world.linear() =
      Eigen::AngleAxisd(random.uniform(-M_PI, M_PI), Eigen::Vector3d::UnitZ()).matrix();
  robot.pose_torso_in_world.translation() << place.x(), place.y(), -sole;
  return robot;
}

bool is_on_carpet(const Eigen::Vector2d& place, const FieldDimensions& field) {
  return std::abs(place.x()) < field.length / 2 + field.border_strip_width - 0.1 &&
         std::abs(place.y()) < field.width / 2 + field.border_strip_width - 0.1;
}

void place_ball(RandomScene& scene, const Eigen::Vector2d& place, double radius, Random& random) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << place.x(), place.y(), radius;
  pose.linear() =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
          .normalized()
          .toRotationMatrix();
  scene.pose_ball_in_world = pose;
}

}  // namespace nao::vision
