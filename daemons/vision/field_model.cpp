#include "daemons/vision/field_model.h"

#include "common/error.h"

namespace nao::vision {

FieldModel::FieldModel(const SceneFile& scene) {
  if (!scene.field) throw ConfigError("scene " + scene.name + " has no field to be localised on");
  const FieldDimensions& field = *scene.field;
  const double x = field.length / 2;
  const double y = field.width / 2;
  add_line(0, -y, 0, y);
  for (const double sign : {-1.0, 1.0}) {
    add_line(sign * x, -y, sign * x, y);
    add_line(-x, sign * y, x, sign * y);
    add_area(sign, x, field.goal_area_length, field.goal_area_width / 2);
    add_area(sign, x, field.penalty_area_length, field.penalty_area_width / 2);
    crossings_.push_back({Kind::kCrossingL, {sign * x, y}});
    crossings_.push_back({Kind::kCrossingL, {sign * x, -y}});
    crossings_.push_back({Kind::kCrossingT, {0, sign * y}});
    if (!scene.goals) continue;
    for (const double side : {-0.5, 0.5}) {
      goal_posts_.emplace_back(sign * (x + scene.goals->post_offset),
                               side * scene.goals->post_distance);
    }
  }
  circle_radius_ = field.centre_circle_diameter / 2;
  half_carpet_ = {x + field.border_strip_width, y + field.border_strip_width};
}

void FieldModel::add_line(double x1, double y1, double x2, double y2) {
  lines_.push_back({{x1, y1}, {x2, y2}});
}

void FieldModel::add_area(double sign, double goal_line, double depth, double half_width) {
  const double front = sign * (goal_line - depth);
  add_line(front, -half_width, front, half_width);
  for (const double side : {-half_width, half_width}) {
    add_line(front, side, sign * goal_line, side);
    crossings_.push_back({Kind::kCrossingL, {front, side}});
    crossings_.push_back({Kind::kCrossingT, {sign * goal_line, side}});
  }
}

}  // namespace nao::vision
