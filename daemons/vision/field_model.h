#pragma once

#include <Eigen/Core>
#include <vector>

#include "daemons/vision/detection.h"
#include "robot_model/scene_file.h"

namespace nao::vision {

/** A straight line of the field, from and to, m, at the middle of its width. */
struct FieldLine {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

/** Where two lines meet: kCrossingL or kCrossingT. */
struct FieldCrossing {
  Kind kind;
  /** m. */
  Eigen::Vector2d position;
};

/** The parts of a soccer field that a camera can recognize, made from the dimensions of a scene.
 *
 * Field frame: origin at the center, x towards the opponents' goal, y left. The field is symmetric:
 * turned by half a turn about its center it looks the same. */
class FieldModel {
 public:
  /** @throws ConfigError  if the scene has no field. */
  explicit FieldModel(const SceneFile& scene);

  /** All straight lines but the short marks at the center and the penalty marks. */
  const std::vector<FieldLine>& lines() const { return lines_; }
  const std::vector<FieldCrossing>& crossings() const { return crossings_; }
  /** Where the axes of the goal posts meet the ground, m; empty without goals. */
  const std::vector<Eigen::Vector2d>& goal_posts() const { return goal_posts_; }
  /** Radius of the center circle, to the middle of its line, m. */
  double circle_radius() const { return circle_radius_; }
  /** Half of the carpet's length and width, with the border strip, m. */
  const Eigen::Vector2d& half_carpet() const { return half_carpet_; }

 private:
  void add_line(double x1, double y1, double x2, double y2);
  /** An area before a goal: a rectangle that has the goal line as one side. @param sign  Sign of
   * the goal's x. */
  void add_area(double sign, double goal_line, double depth, double half_width);

  std::vector<FieldLine> lines_;
  std::vector<FieldCrossing> crossings_;
  std::vector<Eigen::Vector2d> goal_posts_;
  double circle_radius_ = 0;
  Eigen::Vector2d half_carpet_ = Eigen::Vector2d::Zero();
};

}  // namespace nao::vision
