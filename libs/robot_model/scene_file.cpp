#include "robot_model/scene_file.h"

#include <cmath>

#include "common/data_path.h"
#include "common/error.h"
#include "common/yaml_entry.h"

namespace nao {
namespace {

/** Upper limit of all lengths, m, and masses, kg: chosen far beyond any field. */
constexpr double kMaxSize = 1000;

/** A length, m, or a mass, kg. */
double read_size(const YamlEntry& entry) {
  const double size = entry.positive();
  if (size > kMaxSize) entry.fail("must be at most 1000");
  return size;
}

FieldDimensions read_field(const YamlEntry& entry) {
  entry.allow_only({"length", "width", "line_width", "border_strip_width", "penalty_mark_size",
                    "penalty_mark_distance", "goal_area_length", "goal_area_width",
                    "penalty_area_length", "penalty_area_width", "centre_circle_diameter",
                    "centre_mark_length"});
  FieldDimensions field;
  field.length = read_size(entry.at("length"));
  field.width = read_size(entry.at("width"));
  field.line_width = read_size(entry.at("line_width"));
  field.border_strip_width = read_size(entry.at("border_strip_width"));
  field.penalty_mark_size = read_size(entry.at("penalty_mark_size"));
  field.penalty_mark_distance = read_size(entry.at("penalty_mark_distance"));
  field.goal_area_length = read_size(entry.at("goal_area_length"));
  field.goal_area_width = read_size(entry.at("goal_area_width"));
  field.penalty_area_length = read_size(entry.at("penalty_area_length"));
  field.penalty_area_width = read_size(entry.at("penalty_area_width"));
  field.centre_circle_diameter = read_size(entry.at("centre_circle_diameter"));
  field.centre_mark_length = read_size(entry.at("centre_mark_length"));
  return field;
}

GoalDimensions read_goals(const YamlEntry& entry) {
  entry.allow_only({"post_diameter", "post_distance", "post_offset", "crossbar_height", "depth"});
  GoalDimensions goals;
  goals.post_diameter = read_size(entry.at("post_diameter"));
  goals.post_distance = read_size(entry.at("post_distance"));
  goals.post_offset = entry.at("post_offset").number();
  if (std::abs(goals.post_offset) > kMaxSize) {
    entry.at("post_offset").fail("must be within -1000 and 1000");
  }
  goals.crossbar_height = read_size(entry.at("crossbar_height"));
  goals.depth = read_size(entry.at("depth"));
  return goals;
}

BallDescription read_ball(const YamlEntry& entry) {
  entry.allow_only({"radius", "mass", "position"});
  BallDescription ball;
  ball.radius = read_size(entry.at("radius"));
  ball.mass = read_size(entry.at("mass"));
  const std::vector<double> position = entry.at("position").numbers(2);
  ball.position = {position[0], position[1]};
  if (ball.position.cwiseAbs().maxCoeff() > kMaxSize) {
    entry.at("position").fail("must be within -1000 and 1000");
  }
  return ball;
}

}  // namespace

// Field, goals and ball are optional; goals are placed on the field's lines and need one.
SceneFile SceneFile::load(const std::filesystem::path& file) {
  const YamlEntry entry = YamlEntry::load<ConfigError>(file);
  entry.allow_only({"name", "field", "goals", "ball"});
  SceneFile scene;
  scene.name = entry.at("name").text();
  if (entry.has("field")) scene.field = read_field(entry.at("field"));
  if (entry.has("goals")) scene.goals = read_goals(entry.at("goals"));
  if (entry.has("ball")) scene.ball = read_ball(entry.at("ball"));
  if (scene.goals && !scene.field) entry.at("goals").fail("need a field");
  return scene;
}

SceneFile SceneFile::find(const std::string& name) {
  const auto file = data_path() / "scenes" / (name + ".yaml");
  if (!std::filesystem::exists(file)) {
    throw ConfigError("there is no scene \"" + name + "\": " + file.string() + " is missing");
  }
  return load(file);
}

}  // namespace nao
