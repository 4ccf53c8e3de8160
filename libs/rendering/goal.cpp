#include "rendering/goal.h"

#include <Eigen/Geometry>

#include "common/rotation.h"
#include "rendering/primitives.h"

namespace nao {
namespace {

/** Linear light. */
const Color kWhite(0.95f, 0.95f, 0.95f, 1);
const Color kGrey(0.40f, 0.41f, 0.43f, 1);
/** Radius of the bars that carry the net, m. The rules do not give it. */
constexpr float kBarRadius = 0.012f;

/** Dimensions of one goal, m; `sign` is the sign of its x coordinate. */
struct GoalFrame {
  GoalFrame(const FieldDimensions& field, const GoalDimensions& goals, float sign)
      : front(sign * static_cast<float>(field.length / 2 + goals.post_offset)),
        back(sign * static_cast<float>(field.length / 2 + goals.post_offset + goals.depth)),
        half_width(static_cast<float>(goals.post_distance / 2)),
        height(static_cast<float>(goals.crossbar_height)),
        post_radius(static_cast<float>(goals.post_diameter / 2)) {}

  float front;
  float back;
  float half_width;
  float height;
  float post_radius;
};

/** Round bar between two points. */
Mesh make_bar(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius,
              const Color& color, int num_sides) {
  const Eigen::Vector3f along = to - from;
  const auto rotation = rotation_between(Eigen::Vector3f::UnitZ(), along);
  Mesh bar = make_cylinder(radius, along.norm(), color, num_sides);
  for (Vertex& vertex : bar.vertices) {
    vertex.position = (from + to) / 2 + rotation * vertex.position;
    vertex.normal = rotation * vertex.normal;
  }
  return bar;
}

// The roof slopes from the crossbar to the ground at the back; triangles close the sides.
// Coordinates on the net are in m, for the pattern of strings.
void append_nets(std::vector<NetCorner>& corners, const GoalFrame& goal) {
  const Eigen::Vector3f left_top(goal.front, goal.half_width, goal.height);
  const Eigen::Vector3f right_top(goal.front, -goal.half_width, goal.height);
  const Eigen::Vector3f left_back(goal.back, goal.half_width, 0);
  const Eigen::Vector3f right_back(goal.back, -goal.half_width, 0);
  const float slope = (left_back - left_top).norm();
  const NetCorner a{left_top, {goal.half_width, slope}};
  const NetCorner b{right_top, {-goal.half_width, slope}};
  const NetCorner c{right_back, {-goal.half_width, 0}};
  const NetCorner d{left_back, {goal.half_width, 0}};
  corners.insert(corners.end(), {a, b, c, a, c, d});
  for (const float side : {-1.0f, 1.0f}) {
    const float y = side * goal.half_width;
    const Eigen::Vector3f foot(goal.front, y, 0);
    const Eigen::Vector3f top(goal.front, y, goal.height);
    const Eigen::Vector3f back(goal.back, y, 0);
    corners.insert(corners.end(),
                   {NetCorner{foot, {goal.front, 0}}, NetCorner{top, {goal.front, goal.height}},
                    NetCorner{back, {goal.back, 0}}});
  }
}

}  // namespace

Mesh make_goal(const FieldDimensions& field, const GoalDimensions& goals, int end) {
  const GoalFrame goal(field, goals, static_cast<float>(end));
  Mesh mesh;
  const float r = goal.post_radius;
  for (const float side : {-1.0f, 1.0f}) {
    const float y = side * goal.half_width;
    // Up to the crossbar's outer edge.
    append(mesh, make_bar({goal.front, y, 0}, {goal.front, y, goal.height + r}, r, kWhite, 16));
    append(mesh,
           make_bar({goal.front, y, kBarRadius}, {goal.back, y, kBarRadius}, kBarRadius, kGrey, 6));
    append(mesh, make_bar({goal.front, y, goal.height}, {goal.back, y, kBarRadius}, kBarRadius,
                          kGrey, 6));
  }
  append(mesh, make_bar({goal.front, -goal.half_width, goal.height},
                        {goal.front, goal.half_width, goal.height}, r, kWhite, 16));
  append(mesh, make_bar({goal.back, -goal.half_width, kBarRadius},
                        {goal.back, goal.half_width, kBarRadius}, kBarRadius, kGrey, 6));
  return mesh;
}

std::vector<NetCorner> make_nets(const FieldDimensions& field, const GoalDimensions& goals) {
  std::vector<NetCorner> corners;
  for (const float sign : {-1.0f, 1.0f}) append_nets(corners, GoalFrame(field, goals, sign));
  return corners;
}

}  // namespace nao
