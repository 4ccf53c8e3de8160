#include "rendering/field_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace nao {
namespace {

/** Greatest length of a part of a line, and side of a part of the carpet, m. Chosen: with smaller
 * ones the triangles cost more than they save; with larger ones of the carpet its color, which is
 * computed at their corners, differs by more than 2 of 255. */
constexpr float kPieceLength = 0.25f;
constexpr float kCarpetSize = 1.0f;
/** The same for the ground around the carpet, where only haze changes the color; farther away each
 * part is longer than the previous one by a factor. Chosen as for the carpet. */
constexpr float kHallSize = 2.6f;
constexpr float kHallGrowth = 1.6f;
/** Parts of the circle. Chosen: as long as those of lines. */
constexpr int kCircleParts = 36;

/** How far each part of a line reaches over its neighbors, m. Chosen: more than the rounding of
 * corners (1/256 pixel) up to 12 m away, which would leave gaps. */
constexpr float kOverlap = 0.005f;

using Eigen::Vector2f;
using Box = Eigen::AlignedBox2f;

Vector2f half_of(double x, double y) {
  return {static_cast<float>(x / 2), static_cast<float>(y / 2)};
}

Box grown(const Box& box, const Vector2f& margin) {
  return {box.min() - margin, box.max() + margin};
}

/** Length on the ground, m, of a pixel that shows a point of the rectangle: at most this. */
// A pixel at the distance r from an eye at height h is seen r^2 / (f h) long on the ground, with
// the focal length f in pixels.
float pixel_length(const Box& box, const RenderView& view) {
  const Vector2f away = (box.min() - view.eye.head<2>())
                            .cwiseAbs()
                            .cwiseMax((box.max() - view.eye.head<2>()).cwiseAbs());
  const float height = view.eye.z();
  return (away.squaredNorm() + height * height) / (view.pixels_per_radian * height);
}

/** From -half to half in equal parts of at most `size`, m. */
std::vector<float> divided(float half, float size) {
  const auto count = static_cast<int>(std::ceil(2 * half / size));
  std::vector<float> places;
  for (int i = 0; i <= count; ++i) {
    places.push_back(half * static_cast<float>(2 * i - count) / static_cast<float>(count));
  }
  return places;
}

/** Adds places at growing distances before the first and after the last one, up to `reach`, m. */
std::vector<float> with_rings(std::vector<float> places, float reach) {
  for (float step = kHallSize; places.back() < reach; step *= kHallGrowth) {
    const float next = std::min(places.back() + step, reach);
    places.push_back(next);
    places.insert(places.begin(), -next);
  }
  return places;
}

// Neighbors have corners of the same numbers, so that no gap opens between them.
std::vector<GroundPatch> grid(const std::vector<float>& x, const std::vector<float>& y) {
  std::vector<GroundPatch> patches;
  for (size_t i = 0; i + 1 < x.size(); ++i) {
    for (size_t j = 0; j + 1 < y.size(); ++j) {
      patches.emplace_back().box = {Vector2f(x[i], y[j]), Vector2f(x[i + 1], y[j + 1])};
    }
  }
  return patches;
}

bool may_see(const Box& box, const RenderView& view) {
  const Vector2f center = box.center();
  return view.frustum.may_see({center.x(), center.y(), 0}, box.sizes().norm() / 2);
}

}  // namespace

FieldPatches::FieldPatches(const FieldDimensions& field, float reach) {
  add_lines(field);
  const auto strip = static_cast<float>(field.border_strip_width);
  const Vector2f edge = half_of(field.length, field.width).array() + strip;
  add_frame(edge, 0, true);
  // Parts of the same line do not touch sideways, and do not count as other lines to each other.
  for (Piece& piece : pieces_) {
    for (const Piece& other : pieces_) {
      const bool is_same_line = !piece.normal.isZero() &&
                                piece.normal.cwiseAbs() == other.normal.cwiseAbs() &&
                                piece.normal.dot(piece.middle.min() - other.middle.min()) == 0;
      if (is_same_line) continue;
      const float distance = piece.middle.exteriorDistance(other.middle) - other.half_width;
      if (&piece != &other) piece.clearance = std::min(piece.clearance, distance);
    }
  }
  all_carpet_ = grid(divided(edge.x(), kCarpetSize), divided(edge.y(), kCarpetSize));
  all_hall_ = grid(with_rings(divided(edge.x(), kHallSize), reach),
                   with_rings(divided(edge.y(), kHallSize), reach));
  std::erase_if(all_hall_, [&](const GroundPatch& patch) {
    return (patch.box.center().array().abs() < edge.array()).all();
  });
}

void FieldPatches::add_lines(const FieldDimensions& field) {
  const auto half_width = static_cast<float>(field.line_width / 2);
  const Vector2f corner = half_of(field.length, field.width);
  add_frame(corner, half_width, false);
  add_line({0, -corner.y()}, {0, corner.y()}, Vector2f::UnitX(), half_width);
  for (const auto& [length, width] : {std::pair{field.goal_area_length, field.goal_area_width},
                                      {field.penalty_area_length, field.penalty_area_width}}) {
    // Three sides: the fourth one is the goal line.
    const float side = static_cast<float>(width / 2);
    for (const float end : {-1.0f, 1.0f}) {
      const float line = end * (corner.x() - static_cast<float>(length));
      add_line({line, -side}, {line, side}, Vector2f::UnitX(), half_width);
      for (const float y : {-side, side}) {
        add_line({line, y}, {end * corner.x(), y}, Vector2f::UnitY(), half_width);
      }
    }
  }
  const auto add_mixed = [&](const Box& middle) {
    pieces_.push_back({middle, Vector2f::Zero(), false, half_width, 0});
  };
  const Vector2f mark = Vector2f::Constant(static_cast<float>(field.penalty_mark_size / 2));
  const Vector2f penalty(corner.x() - static_cast<float>(field.penalty_mark_distance), 0);
  for (const Vector2f& place : {penalty, Vector2f(-penalty)}) {
    add_mixed({place - mark, place + mark});
  }
  const auto center = static_cast<float>(field.centre_mark_length / 2);
  add_mixed({Vector2f(-center, 0), Vector2f(center, 0)});
  const auto radius = static_cast<float>(field.centre_circle_diameter / 2);
  const auto on_circle = [&](int part) -> Vector2f {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(part) / kCircleParts;
    return radius * Vector2f(std::cos(angle), std::sin(angle));
  };
  // The arc bulges out of the box of its ends by less than the sagitta.
  const float sagitta = radius * (1 - std::cos(std::numbers::pi_v<float> / kCircleParts));
  for (int part = 0; part < kCircleParts; ++part) {
    Box arc(on_circle(part), on_circle(part));
    arc.extend(on_circle(part + 1));
    add_mixed(grown(arc, Vector2f::Constant(sagitta)));
  }
}

void FieldPatches::add_frame(const Vector2f& corner, float half_width, bool is_edge) {
  for (const float side : {-1.0f, 1.0f}) {
    add_line({-corner.x(), side * corner.y()}, {corner.x(), side * corner.y()},
             side * Vector2f::UnitY(), half_width, is_edge);
    add_line({side * corner.x(), -corner.y()}, {side * corner.x(), corner.y()},
             side * Vector2f::UnitX(), half_width, is_edge);
  }
}

void FieldPatches::add_line(const Vector2f& from, const Vector2f& to, const Vector2f& normal,
                            float half_width, bool is_edge) {
  const float length = (to - from).norm();
  const auto count = static_cast<int>(std::ceil(length / kPieceLength));
  for (int part = 0; part < count; ++part) {
    const auto at = [&](int number) -> Vector2f {
      return from + static_cast<float>(number) / static_cast<float>(count) * (to - from);
    };
    Box middle(at(part), at(part));
    middle.extend(at(part + 1));
    middle = grown(middle, kOverlap * normal.unitOrthogonal().cwiseAbs());
    pieces_.push_back(
        {middle, normal, is_edge, half_width, std::numeric_limits<float>::infinity()});
  }
}

void FieldPatches::select(const RenderView& view) {
  mixed_.clear();
  lines_.clear();
  carpet_.clear();
  hall_.clear();
  if (view.eye.z() <= 0) return;  // the ground is seen from above only
  for (const auto& [all, seen] : {std::pair{&all_carpet_, &carpet_}, {&all_hall_, &hall_}}) {
    for (const GroundPatch& patch : *all) {
      if (may_see(patch.box, view)) seen->push_back(patch);
    }
  }
  for (const Piece& piece : pieces_) {
    const float margin = pixel_length(piece.middle, view);
    const float half = piece.half_width + margin;
    if (half + margin < piece.clearance) {
      const Box box = grown(piece.middle, half * piece.normal.cwiseAbs());
      if (may_see(box, view)) {
        lines_.push_back({box, piece.normal, piece.normal.dot(piece.middle.min()), piece.is_edge});
      }
    } else {
      const Box box = grown(piece.middle, Vector2f::Constant(half));
      if (may_see(box, view)) mixed_.push_back({box});
    }
  }
}

}  // namespace nao
