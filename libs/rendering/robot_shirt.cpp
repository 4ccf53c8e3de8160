#include "rendering/robot_shirt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace nao {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/** Heights of the band as fractions of the torso's. Chosen: below the shoulders, above the hips. */
constexpr float kBottom = 0.25f;
constexpr float kTop = 0.7f;
/** Distance of the band from the torso, and of the number from the band, m. */
constexpr float kThickness = 0.004f;
constexpr float kNumberOffset = 0.001f;
/** Height of a digit as a fraction of the band's; its width and stroke thickness as fractions of
 * its height. */
constexpr float kDigitHeight = 0.7f;
constexpr float kDigitWidth = 0.5f;
constexpr float kStroke = 0.16f;
const Color kNumberColor(0.95f, 0.95f, 0.95f, 1);
/** As in the app: #2f6fe0 and #c8363c. */
const Color kTeamColors[] = {{0.028f, 0.159f, 0.745f, 1}, {0.578f, 0.037f, 0.045f, 1}};

/** Segments of a seven-segment display, by their usual letters: top, upper left, upper right,
 * middle, lower left, lower right, bottom; and those of each digit. */
enum Segment : unsigned { kA = 1, kF = 2, kB = 4, kG = 8, kE = 16, kC = 32, kD = 64 };
constexpr std::array<unsigned, 10> kDigits{
    kA | kB | kC | kD | kE | kF, kB | kC,           kA | kB | kG | kE | kD,
    kA | kB | kG | kC | kD,      kF | kG | kB | kC, kA | kF | kG | kC | kD,
    kA | kF | kG | kE | kC | kD, kA | kB | kC,      kA | kB | kC | kD | kE | kF | kG,
    kA | kB | kC | kD | kF | kG};

/** Cross product of b - a and c - a. */
float turn(const Vector2f& a, const Vector2f& b, const Vector2f& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/** Convex hull, counter-clockwise (A. M. Andrew's monotone chain, 1979). */
std::vector<Vector2f> convex_hull(std::vector<Vector2f> points) {
  std::sort(points.begin(), points.end(), [](const Vector2f& a, const Vector2f& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Vector2f> hull;
  const auto extend = [&hull](const Vector2f& point, size_t least) {
    while (hull.size() > least && turn(hull[hull.size() - 2], hull.back(), point) <= 1e-9f) {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const Vector2f& point : points) extend(point, 1);
  const size_t lower = hull.size();
  for (auto it = points.rbegin() + 1; it < points.rend(); ++it) extend(*it, lower);
  if (!hull.empty()) hull.pop_back();
  return hull;
}

/** The part of a segment between two heights; nothing if there is none. */
std::optional<std::array<Vector3f, 2>> clipped(const Vector3f& a, const Vector3f& b, float bottom,
                                               float top) {
  float from = 0;
  float to = 1;
  const float rise = b.z() - a.z();
  if (std::abs(rise) < 1e-9f) {
    if (a.z() < bottom || a.z() > top) return std::nullopt;
  } else {
    const float at_bottom = (bottom - a.z()) / rise;
    const float at_top = (top - a.z()) / rise;
    from = std::max(from, std::min(at_bottom, at_top));
    to = std::min(to, std::max(at_bottom, at_top));
    if (from > to) return std::nullopt;
  }
  return std::array<Vector3f, 2>{Vector3f(a + from * (b - a)), Vector3f(a + to * (b - a))};
}

void add_polygon(Mesh& mesh, const std::vector<Vector3f>& corners, const Vector3f& normal) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vector3f& corner : corners) {
    Vertex vertex;
    vertex.position = corner;
    vertex.normal = normal;
    mesh.vertices.push_back(vertex);
  }
  for (uint32_t i = 2; i < corners.size(); ++i) {
    mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
  }
}

/** The outline from the bottom to the top, closed. */
Mesh extruded(const std::vector<Vector2f>& outline, float bottom, float top) {
  Mesh mesh;
  const auto at = [](const Vector2f& point, float z) { return Vector3f(point.x(), point.y(), z); };
  std::vector<Vector3f> floor;
  std::vector<Vector3f> ceiling;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vector2f& a = outline[i];
    const Vector2f& b = outline[(i + 1) % outline.size()];
    const Vector3f normal = Vector3f(b.y() - a.y(), a.x() - b.x(), 0).normalized();
    add_polygon(mesh, {at(a, bottom), at(b, bottom), at(b, top), at(a, top)}, normal);
    ceiling.push_back(at(a, top));
    floor.insert(floor.begin(), at(a, bottom));
  }
  add_polygon(mesh, ceiling, Vector3f::UnitZ());
  add_polygon(mesh, floor, -Vector3f::UnitZ());
  return mesh;
}

}  // namespace

RobotShirt make_shirt(const Mesh& torso) {
  RobotShirt shirt;
  if (torso.vertices.empty()) return shirt;
  float low = torso.vertices[0].position.z();
  float high = low;
  for (const Vertex& vertex : torso.vertices) {
    low = std::min(low, vertex.position.z());
    high = std::max(high, vertex.position.z());
  }
  shirt.bottom = low + kBottom * (high - low);
  shirt.top = low + kTop * (high - low);
  std::vector<Vector2f> points;
  for (size_t i = 0; i < torso.indices.size(); ++i) {
    const size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const auto part =
        clipped(torso.vertices[torso.indices[i]].position,
                torso.vertices[torso.indices[next]].position, shirt.bottom, shirt.top);
    if (!part) continue;
    for (const Vector3f& end : *part) points.emplace_back(end.x(), end.y());
  }
  std::vector<Vector2f> outline = convex_hull(std::move(points));
  if (outline.size() < 3) return shirt;
  Vector2f center = Vector2f::Zero();
  for (const Vector2f& point : outline) center += point / static_cast<float>(outline.size());
  for (Vector2f& point : outline) point += kThickness * (point - center).normalized();
  shirt.front = shirt.back = outline[0].x();
  for (const Vector2f& point : outline) {
    shirt.front = std::max(shirt.front, point.x() + kNumberOffset);
    shirt.back = std::min(shirt.back, point.x() - kNumberOffset);
  }
  shirt.band = extruded(outline, shirt.bottom, shirt.top);
  return shirt;
}

Color shirt_color(int team) {
  return kTeamColors[team == 0 ? 0 : 1];
}

void append_number(Scene& scene, const RobotShirt& shirt,
                   const Eigen::Isometry3f& pose_torso_in_world, int number) {
  const float height = kDigitHeight * (shirt.top - shirt.bottom);
  const float width = kDigitWidth * height;
  const float stroke = kStroke * height;
  const float bottom = (shirt.bottom + shirt.top - height) / 2;
  const int num_digits = number > 9 ? 2 : 1;
  const float step = width + stroke;
  // Corners: along the digits as they are read, and upwards, m.
  const auto add_bar = [&](float left, float right, float low, float high) {
    for (const float side : {1.0f, -1.0f}) {
      // Seen from ahead, reading goes along y; seen from behind, against it.
      const float x = side > 0 ? shirt.front : shirt.back;
      const auto corner = [&](float along, float z) -> Vector3f {
        return pose_torso_in_world * Vector3f(x, side * along, bottom + z);
      };
      scene.triangles.push_back(
          {{corner(left, low), corner(right, low), corner(right, high)}, kNumberColor});
      scene.triangles.push_back(
          {{corner(left, low), corner(right, high), corner(left, high)}, kNumberColor});
    }
  };
  for (int i = 0; i < num_digits; ++i) {
    // A robot that looks along x has y to its left, which is on the right for a person facing it.
    const float center = (static_cast<float>(i) - 0.5f * static_cast<float>(num_digits - 1)) * step;
    const float left = center - width / 2;
    const int digit = num_digits == 2 && i == 0 ? number / 10 % 10 : number % 10;
    if (digit == 1) {
      // A seven-segment display has this stroke at the side.
      add_bar(center - stroke / 2, center + stroke / 2, 0, height);
      continue;
    }
    const unsigned segments = kDigits[static_cast<size_t>(digit)];
    const float right = left + width;
    const float middle = (height - stroke) / 2;
    if ((segments & kA) != 0) add_bar(left, right, height - stroke, height);
    if ((segments & kG) != 0) add_bar(left, right, middle, middle + stroke);
    if ((segments & kD) != 0) add_bar(left, right, 0, stroke);
    if ((segments & kF) != 0) add_bar(left, left + stroke, middle, height);
    if ((segments & kB) != 0) add_bar(right - stroke, right, middle, height);
    if ((segments & kE) != 0) add_bar(left, left + stroke, 0, middle + stroke);
    if ((segments & kC) != 0) add_bar(right - stroke, right, 0, middle + stroke);
  }
}

}  // namespace nao
