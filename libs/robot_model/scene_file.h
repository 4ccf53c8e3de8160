#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

namespace nao {

/** Lines of a soccer field, m. Areas and circles are measured to the center of their lines. */
struct FieldDimensions {
  /** Along x and y, to the center of the outer lines. */
  double length = 0;
  double width = 0;
  double line_width = 0;
  /** Width of the carpet beyond the center of the outer lines. */
  double border_strip_width = 0;
  double penalty_mark_size = 0;
  /** From the center of the goal line. */
  double penalty_mark_distance = 0;
  double goal_area_length = 0;
  double goal_area_width = 0;
  double penalty_area_length = 0;
  double penalty_area_width = 0;
  double centre_circle_diameter = 0;
  double centre_mark_length = 0;
};

/** The two goals, one at each end of the field, m. */
struct GoalDimensions {
  double post_diameter = 0;
  /** Distance between the axes of a goal's posts, which are at y = +-post_distance / 2. */
  double post_distance = 0;
  /** Distance of the posts' axes behind the center of the goal line. */
  double post_offset = 0;
  /** Height of the crossbar's axis. */
  double crossbar_height = 0;
  /** Distance from the posts' axes to the back of the net. */
  double depth = 0;
};

/** The ball, and where it is at the start. */
struct BallDescription {
  /** m. */
  double radius = 0;
  /** kg. */
  double mass = 0;
  /** Its contact point with the ground, m, in the world. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

/** The surroundings of the robots in a simulated world: a file in scenes/ of the data folder.
 *
 * World frame: x along the field, y left, z up, origin on the ground at the center of the field. */
struct SceneFile {
  std::string name;
  /** Nothing: the ground is a plain floor. */
  std::optional<FieldDimensions> field;
  /** Only with a field. */
  std::optional<GoalDimensions> goals;
  std::optional<BallDescription> ball;

  /** Reads a file.
   * @throws ConfigError  with the file, and the key that is missing, unknown or out of range. */
  static SceneFile load(const std::filesystem::path& file);

  /** Reads scenes/NAME.yaml of the data folder, as load() does. */
  static SceneFile find(const std::string& name);
};

}  // namespace nao
