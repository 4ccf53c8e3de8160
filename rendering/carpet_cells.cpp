#include "rendering/carpet_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nao {
namespace {

/** Side of a cell, m. Chosen: smaller ones save less shading than their triangles cost. */
constexpr float kCellSize = 0.25f;

using Eigen::Vector2f;
using Box = Eigen::AlignedBox2f;

/** Distance of a rectangle from the circle of a radius about the origin, 0 if it is crossed. */
float distance_to_circle(const Box& cell, float radius) {
  const float nearest = cell.min().cwiseMax(-cell.max()).cwiseMax(0.0f).norm();
  const float farthest = cell.min().cwiseAbs().cwiseMax(cell.max().cwiseAbs()).norm();
  return std::max({0.0f, nearest - radius, radius - farthest});
}

void add_frame(std::vector<Box>& lines, const Vector2f& min, const Vector2f& max) {
  lines.emplace_back(min, Vector2f(max.x(), min.y()));
  lines.emplace_back(Vector2f(min.x(), max.y()), max);
  lines.emplace_back(min, Vector2f(min.x(), max.y()));
  lines.emplace_back(Vector2f(max.x(), min.y()), max);
}

/** Middles of the lines along x and y, and marks. */
std::vector<Box> straight_lines(const FieldDimensions& field) {
  const auto half = [](double size) { return static_cast<float>(size / 2); };
  const Vector2f corner(half(field.length), half(field.width));
  std::vector<Box> lines;
  add_frame(lines, -corner, corner);
  lines.emplace_back(Vector2f(0, -corner.y()), Vector2f(0, corner.y()));
  for (const auto& [length, width] :
       {std::array{field.goal_area_length, field.goal_area_width},
        std::array{field.penalty_area_length, field.penalty_area_width}}) {
    const Vector2f area(static_cast<float>(length), half(width));
    add_frame(lines, {corner.x() - area.x(), -area.y()}, {corner.x(), area.y()});
    add_frame(lines, {-corner.x(), -area.y()}, {area.x() - corner.x(), area.y()});
  }
  const float mark = half(std::max(field.penalty_mark_size, field.centre_mark_length));
  const float penalty_mark = corner.x() - static_cast<float>(field.penalty_mark_distance);
  for (const float x : {-penalty_mark, 0.0f, penalty_mark}) {
    lines.emplace_back(Vector2f(x - mark, -mark), Vector2f(x + mark, mark));
  }
  return lines;
}

}  // namespace

CarpetCells::CarpetCells(const FieldDimensions& field) {
  const auto strip = static_cast<float>(field.border_strip_width);
  const Vector2f edge(static_cast<float>(field.length / 2) + strip,
                      static_cast<float>(field.width / 2) + strip);
  std::vector<Box> lines = straight_lines(field);
  add_frame(lines, -edge, edge);
  const auto radius = static_cast<float>(field.centre_circle_diameter / 2);
  const Eigen::Vector2i count = (2 * edge / kCellSize).array().floor().cast<int>();
  for (int row = 0; row < count.x(); ++row) {
    for (int column = 0; column < count.y(); ++column) {
      Cell cell;
      cell.box = {-edge + kCellSize * Vector2f(row, column),
                  -edge + kCellSize * Vector2f(row + 1, column + 1)};
      cell.clearance = distance_to_circle(cell.box, radius);
      for (const Box& line : lines) {
        cell.clearance = std::min(cell.clearance, cell.box.exteriorDistance(line));
      }
      cell.clearance -= static_cast<float>(field.line_width / 2);
      if (cell.clearance > 0) cells_.push_back(cell);
    }
  }
}

// A pixel at the distance r from an eye at height h is seen r^2 / (f h) long on the ground, with
// the focal length f in pixels; half of it lies on either side of its center. Twice that half
// allows for the growth from one pixel to the next and for a corner of the image.
const std::vector<Box>& CarpetCells::without_lines(const RenderView& view) {
  selected_.clear();
  if (view.eye.z() <= 0) return selected_;
  const float length_per_square = 1 / (view.pixels_per_radian * view.eye.z());
  for (const auto& [box, clearance] : cells_) {
    const Vector2f away = (box.min() - view.eye.head<2>())
                              .cwiseAbs()
                              .cwiseMax((box.max() - view.eye.head<2>()).cwiseAbs());
    const float square = away.squaredNorm() + view.eye.z() * view.eye.z();
    if (square * length_per_square > clearance) continue;
    const bool continues = !selected_.empty() && selected_.back().min().x() == box.min().x() &&
                           selected_.back().max().y() == box.min().y();
    if (continues) {
      selected_.back().extend(box);
    } else {
      selected_.push_back(box);
    }
  }
  return selected_;
}

}  // namespace nao
