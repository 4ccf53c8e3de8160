#include "sim/goal_shapes.h"

namespace nao::sim {

using Eigen::Vector3d;

std::vector<StaticShape> make_goal_shapes(const SceneFile& scene) {
  std::vector<StaticShape> shapes;
  if (!scene.goals) return shapes;
  // Half the thickness of a net, m: a ball of 10 m/s moves twice as far in a step of 2 ms, within
  // the radius (5 cm) of the ball. Chosen.
  constexpr double kNetRadius = 0.01;
  // Half the thickness of the box inside the back net, m. Chosen small beside kNetRadius.
  constexpr double kNetHalfThickness = 0.001;
  const GoalDimensions& goals = *scene.goals;
  const double radius = goals.post_diameter / 2;
  const double half_width = goals.post_distance / 2;
  // Both goals mirror each other; `side` is the sign of their x in W. Nets lie behind the line.
  for (const double side : {1.0, -1.0}) {
    const double x = side * (scene.field->length / 2 + goals.post_offset);
    for (const double y : {half_width, -half_width}) {
      // A capsule whose lower end is in the ground.
      StaticShape post;
      post.shape.center = {x, y, goals.crossbar_height / 2};
      post.shape.half.z() = goals.crossbar_height / 2;
      post.shape.radius = radius;
      shapes.push_back(post);
      // A box of no thickness with rounded edges, from the post to the goal's depth.
      StaticShape side_net;
      side_net.is_net = true;
      side_net.shape.radius = kNetRadius;
      side_net.shape.center = {x + side * goals.depth / 2, y, goals.crossbar_height / 2};
      side_net.shape.half = {goals.depth / 2, 0, goals.crossbar_height / 2};
      shapes.push_back(side_net);
    }
    StaticShape crossbar;
    // A capsule lies along its z axis; the crossbar's is turned onto y.
    crossbar.shape.center = {x, 0, goals.crossbar_height};
    crossbar.shape.rotation = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()).toRotationMatrix();
    crossbar.shape.half.z() = half_width;
    crossbar.shape.radius = radius;
    shapes.push_back(crossbar);
    StaticShape back_net;
    back_net.is_net = true;
    back_net.shape.radius = kNetRadius;
    back_net.shape.center = {x + side * goals.depth, 0, goals.crossbar_height / 2};
    back_net.shape.half = {kNetHalfThickness, half_width, goals.crossbar_height / 2};
    shapes.push_back(back_net);
  }
  return shapes;
}

}  // namespace nao::sim
