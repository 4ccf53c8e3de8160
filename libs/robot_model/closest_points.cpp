#include "robot_model/closest_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nao {
namespace {

using Eigen::Vector3d;

/** Support mapping: the corner of the inner box that is farthest in a direction. */
Vector3d support(const RoundedBox& box, const Vector3d& direction) {
  const Vector3d local = box.rotation.transpose() * direction;
  // copysign also for half lengths of 0, which then give 0: spheres and capsules need no case.
  const Vector3d corner(std::copysign(box.half.x(), local.x()),
                        std::copysign(box.half.y(), local.y()),
                        std::copysign(box.half.z(), local.z()));
  return box.center + box.rotation * corner;
}

/** A vertex of the Minkowski difference a - b, the points whose difference it is, and its weight
 * (barycentric coordinate) in the simplex's point nearest to 0. */
struct Vertex {
  Vector3d difference;
  Vector3d on_a;
  Vector3d on_b;
  double weight = 0;
};

/** Up to four vertices of the Minkowski difference, the corners of a simplex. */
struct Simplex {
  std::array<Vertex, 4> vertices;
  int size = 0;

  Vector3d nearest() const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < size; ++i) sum += vertices[i].weight * vertices[i].difference;
    return sum;
  }
};

/** Point of a segment nearest to 0. @param weight  The corners' weights, output. @return Squared
 * distance. */
double nearest_on_segment(const Vector3d& a, const Vector3d& b, double* weight) {
  const Vector3d ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0 ? std::clamp(-a.dot(ab) / length, 0.0, 1.0) : 0.0;
  weight[0] = 1 - t;
  weight[1] = t;
  return (a + t * ab).squaredNorm();
}

/** The same for a triangle: inside (Ericson, Real-Time Collision Detection, 5.1.5), or on the
 * nearest of its edges. */
double nearest_on_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                           double* weight) {
  const Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  // Not a degenerate triangle (the squared area of one with sides of 30 nm).
  if (area > 1e-30) {
    // Barycentric coordinates of 0's projection onto the plane.
    // u = [0 b c] / [a b c] areas with their signs, by cross products in the triangle's plane.
    const double u = b.cross(c).dot(normal) / area;
    const double v = c.cross(a).dot(normal) / area;
    const double w = 1 - u - v;
    if (u >= 0 && v >= 0 && w >= 0) {
      weight[0] = u;
      weight[1] = v;
      weight[2] = w;
      return (u * a + v * b + w * c).squaredNorm();
    }
  }
  // Outside, or degenerate: the nearest point is on an edge.
  const Vector3d* corners[] = {&a, &b, &c};
  double best = -1;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    double pair[2];
    const double distance = nearest_on_segment(*corners[i], *corners[j], pair);
    if (best >= 0 && distance >= best) continue;
    best = distance;
    weight[i] = pair[0];
    weight[j] = pair[1];
    // 3 - i - j is the index of the third corner.
    weight[3 - i - j] = 0;
  }
  return best;
}

/** The same for a tetrahedron, on the nearest of the faces that separate 0 from the fourth corner.
 * @return false if 0 is inside. */
bool nearest_on_tetrahedron(const Simplex& simplex, double* weight) {
  static constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  double best = -1;
  bool is_inside = true;
  for (const auto& face : kFaces) {
    const Vector3d& a = simplex.vertices[face[0]].difference;
    const Vector3d& b = simplex.vertices[face[1]].difference;
    const Vector3d& c = simplex.vertices[face[2]].difference;
    const Vector3d& opposite = simplex.vertices[face[3]].difference;
    const Vector3d normal = (b - a).cross(c - a);
    // 0 and the fourth corner on the same side of a face: the face does not separate them.
    const double side_of_zero = -a.dot(normal);
    const double side_of_opposite = (opposite - a).dot(normal);
    const bool is_flat = std::abs(side_of_opposite) < 1e-15;
    if (!is_flat && side_of_zero * side_of_opposite >= 0) continue;
    is_inside = false;
    double face_weight[3];
    const double distance = nearest_on_triangle(a, b, c, face_weight);
    if (best >= 0 && distance >= best) continue;
    best = distance;
    for (int i = 0; i < 3; ++i) weight[face[i]] = face_weight[i];
    weight[face[3]] = 0;
  }
  return !is_inside;
}

/** Reduces the simplex to the smallest face that contains its point nearest to 0. @return false if
 * the simplex contains 0. */
bool reduce(Simplex& simplex) {
  double weight[4] = {1, 0, 0, 0};
  auto& v = simplex.vertices;
  if (simplex.size == 2) nearest_on_segment(v[0].difference, v[1].difference, weight);
  if (simplex.size == 3) {
    nearest_on_triangle(v[0].difference, v[1].difference, v[2].difference, weight);
  }
  if (simplex.size == 4 && !nearest_on_tetrahedron(simplex, weight)) return false;
  // Corners with weight 0 do not carry the nearest point, and make room for the next vertex.
  int kept = 0;
  for (int i = 0; i < simplex.size; ++i) {
    if (weight[i] <= 0) continue;
    v[kept] = v[i];
    v[kept].weight = weight[i];
    ++kept;
  }
  simplex.size = kept;
  return true;
}

// Distance, normal and contact point of the rounded shapes from the nearest points of the inner
// ones.
Proximity from_core_points(const RoundedBox& a, const RoundedBox& b, const Vector3d& on_a,
                           const Vector3d& on_b, double distance) {
  Proximity result;
  result.distance = distance - a.radius - b.radius;
  result.normal = (on_a - on_b) / distance;
  const Vector3d surface_a = on_a - a.radius * result.normal;
  const Vector3d surface_b = on_b + b.radius * result.normal;
  result.point = (surface_a + surface_b) / 2;
  return result;
}

/** For inner boxes that overlap: the separating axis with the least overlap, among the boxes' axes
 * and their cross products. */
Proximity least_overlap(const RoundedBox& a, const RoundedBox& b) {
  const Vector3d offset = a.center - b.center;
  double least = -1;
  Vector3d best = Vector3d::UnitZ();
  const auto try_axis = [&](const Vector3d& direction) {
    const double length = direction.norm();
    if (length < 1e-9) return;
    // Projections of both boxes on the axis: half lengths weighted with |cosines|.
    const Vector3d axis = direction / length;
    const double reach = (a.rotation.transpose() * axis).cwiseAbs().dot(a.half) +
                         (b.rotation.transpose() * axis).cwiseAbs().dot(b.half);
    const double along = offset.dot(axis);
    // Distance by which the boxes must be moved apart along the axis.
    const double overlap = reach - std::abs(along);
    if (least >= 0 && overlap >= least) return;
    least = std::max(overlap, 0.0);
    best = along >= 0 ? axis : Vector3d(-axis);
  };
  // 15 axes: 3 faces of each box and 9 pairs of edges; parallel edges give none.
  for (int i = 0; i < 3; ++i) {
    try_axis(a.rotation.col(i));
    try_axis(b.rotation.col(i));
    for (int j = 0; j < 3; ++j) try_axis(a.rotation.col(i).cross(b.rotation.col(j)));
  }
  Proximity result;
  result.distance = -least - a.radius - b.radius;
  result.normal = best;
  result.point = (support(a, -best) + support(b, best)) / 2;
  return result;
}

bool is_line(const RoundedBox& box) {
  return box.half.x() == 0 && box.half.y() == 0;
}

/** Two spheres or capsules: the closest points of their segments (Ericson, Real-Time Collision
 * Detection, 5.1.9). @return false if the segments intersect. */
bool closest_of_lines(const RoundedBox& a, const RoundedBox& b, Proximity& result) {
  const Vector3d u = a.rotation.col(2) * a.half.z();
  const Vector3d v = b.rotation.col(2) * b.half.z();
  const Vector3d r = a.center - b.center;
  // Points a.center + s u and b.center + t v, s and t in -1..1.
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double ur = u.dot(r);
  const double vr = v.dot(r);
  const double determinant = uu * vv - uv * uv;
  double s = 0;
  // Parallel segments keep s = 0, the middle of a; t is then found for it.
  if (determinant > 1e-12 * uu * vv) {
    s = std::clamp((uv * vr - ur * vv) / determinant, -1.0, 1.0);
  }
  // Best t for this s, clamped, and again the best s for this t: exact for two segments.
  double t = vv > 0 ? (uv * s + vr) / vv : 0.0;
  if (t < -1 || t > 1) t = std::clamp(t, -1.0, 1.0);
  if (uu > 0) s = std::clamp((uv * t - ur) / uu, -1.0, 1.0);
  const Vector3d on_a = a.center + s * u;
  const Vector3d on_b = b.center + t * v;
  const double distance = (on_a - on_b).norm();
  if (distance < 1e-9) return false;
  result = from_core_points(a, b, on_a, on_b, distance);
  return true;
}

}  // namespace

Proximity closest_points(const RoundedBox& a, const RoundedBox& b) {
  Proximity result;
  if (is_line(a) && is_line(b)) {
    return closest_of_lines(a, b, result) ? result : least_overlap(a, b);
  }
  // A safeguard: on boxes the algorithm ends after a few iterations.
  constexpr int kMaxIterations = 32;
  // Relative, of the squared distance.
  constexpr double kTolerance = 1e-10;
  Simplex simplex;
  Vector3d nearest = a.center - b.center;
  // The centers coincide: there is no direction to begin with.
  if (nearest.squaredNorm() == 0) return least_overlap(a, b);
  // GJK iteration. Invariant: `nearest` is the point of the simplex nearest to 0, a point of the
  // Minkowski difference a - b; |nearest| never increases and ends as the distance.
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Vertex vertex;
    // Vertex of the difference that is farthest towards 0.
    vertex.on_a = support(a, -nearest);
    vertex.on_b = support(b, nearest);
    vertex.difference = vertex.on_a - vertex.on_b;
    const double square = nearest.squaredNorm();
    // No vertex is nearer to 0 along this direction: the distance is found.
    if (simplex.size > 0 && square - nearest.dot(vertex.difference) <= kTolerance * square) break;
    if (simplex.size == 4) break;
    simplex.vertices[simplex.size++] = vertex;
    if (!reduce(simplex)) return least_overlap(a, b);
    const Vector3d next = simplex.nearest();
    if (next.squaredNorm() < 1e-18) return least_overlap(a, b);
    // Rounding prevents further progress.
    if (iteration > 0 && next.squaredNorm() >= square) break;
    nearest = next;
  }
  Vector3d on_a = Vector3d::Zero();
  Vector3d on_b = Vector3d::Zero();
  // The same barycentric weights give the nearest points on both inner boxes.
  for (int i = 0; i < simplex.size; ++i) {
    on_a += simplex.vertices[i].weight * simplex.vertices[i].on_a;
    on_b += simplex.vertices[i].weight * simplex.vertices[i].on_b;
  }
  return from_core_points(a, b, on_a, on_b, (on_a - on_b).norm());
}

}  // namespace nao
