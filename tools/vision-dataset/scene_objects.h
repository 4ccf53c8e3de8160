#pragma once

#include "tools/vision-dataset/random_scene.h"

// What scenes consist of; places in m in the world, colors in linear light.
namespace nao::vision {

Eigen::Vector3f random_color(Random& random, double lower, double upper);

/** @param yaw  rad. */
void add_box(RandomScene& scene, const Eigen::Vector3d& center, double yaw,
             const Eigen::Vector3d& size, const Eigen::Vector3f& color);

/** Two legs, shoes and a body. */
void add_person(RandomScene& scene, const Eigen::Vector2d& place, Random& random);

/** A robot in a standing posture, in any direction. */
PlacedRobot place_robot(const RobotModel& model, const Eigen::Vector2d& place, Random& random);

/** The ball on the ground, in any orientation. */
void place_ball(RandomScene& scene, const Eigen::Vector2d& place, double radius, Random& random);

bool is_on_carpet(const Eigen::Vector2d& place, const FieldDimensions& field);

}  // namespace nao::vision
