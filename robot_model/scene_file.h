#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

namespace nao {

/** Lines of a soccer field, m. Areas and circles are measured to the middle of their lines. */
struct FieldDimensions {
  /** Along x and y, to the middle of the outer lines. */
  double length = 0;
  double width = 0;
  double line_width = 0;
  /** Carpet beyond the middle of the outer lines. */
  double border_strip_width = 0;
  double penalty_mark_size = 0;
  /** From the middle of the goal line. */
  double penalty_mark_distance = 0;
  double goal_area_length = 0;
  double goal_area_width = 0;
  double penalty_area_length = 0;
  double penalty_area_width = 0;
  double centre_circle_diameter = 0;
  double centre_mark_length = 0;
};

/** The two goals, which stand at both ends of the field, m. */
struct GoalDimensions {
  double post_diameter = 0;
  /** Between the axes of a goal's posts, which stand at y = +-post_distance / 2. */
  double post_distance = 0;
  /** Axis of the posts behind the middle of the goal line. */
  double post_offset = 0;
  /** Axis of the crossbar over the ground. */
  double crossbar_height = 0;
  /** Axis of the posts to the back of the net. */
  double depth = 0;
};

/** The ball as it lies at the start. */
struct BallDescription {
  /** m. */
  double radius = 0;
  /** kg. */
  double mass = 0;
  /** Where it touches the ground, m, in the world. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

/** What stands in a simulated world besides the robots: one file of the data folder's scenes/.
 *
 * World frame: x along the field, y left, z up, origin on the ground at the centre of the field. */
struct SceneFile {
  std::string name;
  /** Without a field the ground is a plain floor. */
  std::optional<FieldDimensions> field;
  /** Only with a field. */
  std::optional<GoalDimensions> goals;
  std::optional<BallDescription> ball;

  /** Reads a file.
   * @throws ConfigError  naming the file, and the key that is missing, unknown or out of range. */
  static SceneFile load(const std::filesystem::path& file);

  /** Reads scenes/NAME.yaml of the data folder, as load() does. */
  static SceneFile find(const std::string& name);
};

}  // namespace nao
