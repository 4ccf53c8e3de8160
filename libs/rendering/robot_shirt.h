#pragma once

#include <Eigen/Geometry>

#include "rendering/mesh.h"
#include "rendering/scene.h"

namespace nao {

/** A shirt around a robot's torso: a band with a number in front and behind.
 *
 * It is made of the torso's own shape, so that every robot can wear one: the convex outline, seen
 * from above, of the torso between two heights. */
struct RobotShirt {
  /** White, in the torso's frame (x ahead, y left, z up); empty if the torso has no shape. */
  Mesh band;
  /** x of the planes of the numbers in front and behind, and their heights, m. */
  float front = 0;
  float back = 0;
  float bottom = 0;
  float top = 0;
};

/** @param torso  The torso's triangles, in its frame, m. */
RobotShirt make_shirt(const Mesh& torso);

/** Color of a team's shirt, linear. @param team  0 (blue) or 1 (red). */
Color shirt_color(int team);

/** Adds a number to a scene, in front and behind. @param number  1 to 99. */
void append_number(Scene& scene, const RobotShirt& shirt,
                   const Eigen::Isometry3f& pose_torso_in_world, int number);

}  // namespace nao
