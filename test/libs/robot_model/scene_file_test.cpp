#include "robot_model/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

void expect_refused(const std::string& text, const std::string& reason) {
  const TemporaryFolder folder;
  const std::filesystem::path scene = folder.path() / "scene.yaml";
  write_text(scene, text);
  try {
    SceneFile::load(scene);
    ADD_FAILURE() << "accepted: " << text;
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(reason));
    EXPECT_THAT(error.what(), testing::HasSubstr(scene.string()));
  }
}

TEST(SceneFile, ReadsTheSoccerField) {
  const SceneFile scene =
      SceneFile::load(std::filesystem::path(NAO_SOURCE_DIR) / "data/scenes/soccer.yaml");
  EXPECT_EQ(scene.name, "soccer");
  ASSERT_TRUE(scene.field && scene.goals && scene.ball);
  EXPECT_DOUBLE_EQ(scene.field->length, 9);
  EXPECT_DOUBLE_EQ(scene.field->penalty_area_width, 4);
  EXPECT_DOUBLE_EQ(scene.goals->post_distance, 1.6);
  EXPECT_DOUBLE_EQ(scene.ball->radius, 0.05);
}

/** The league's table measures from the outside of the lines, and goals between their posts. */
TEST(SceneFile, HasTheFieldsOfTheLeagueOf2026) {
  struct Row {
    std::string name;
    double length, width, goal_area_length, goal_area_width, penalty_area_length,
        penalty_area_width, penalty_mark_distance, circle, line, goal_width, min_height, max_height;
  };
  // Source: HSL-Rules, rules/environment.tex, tables of field and goal dimensions.
  for (const Row& row :
       std::vector<Row>{{"hsl_small", 9, 6, 1, 3, 2, 4, 1.5, 1.5, 0.05, 1.8, 1.2, 1.3},
                        {"hsl_middle", 14, 9, 1, 4, 3, 6, 2, 3, 0.05, 2.4, 1.5, 1.9},
                        {"hsl_large", 22, 14, 1, 5, 3.5, 7, 2.5, 4, 0.12, 2.6, 1.8, 2}}) {
    const SceneFile scene = SceneFile::load(std::filesystem::path(NAO_SOURCE_DIR) / "data/scenes" /
                                            (row.name + ".yaml"));
    EXPECT_EQ(scene.name, row.name);
    ASSERT_TRUE(scene.field && scene.goals && scene.ball) << row.name;
    const FieldDimensions& field = *scene.field;
    const double line = field.line_width;
    EXPECT_EQ(line, row.line);
    EXPECT_NEAR(field.length + line, row.length, 1e-9) << row.name;
    EXPECT_NEAR(field.width + line, row.width, 1e-9);
    EXPECT_NEAR(field.goal_area_length + line, row.goal_area_length, 1e-9);
    EXPECT_NEAR(field.goal_area_width + line, row.goal_area_width, 1e-9);
    EXPECT_NEAR(field.penalty_area_length + line, row.penalty_area_length, 1e-9);
    EXPECT_NEAR(field.penalty_area_width + line, row.penalty_area_width, 1e-9);
    EXPECT_NEAR(field.penalty_mark_distance + line / 2, row.penalty_mark_distance, 1e-9);
    EXPECT_NEAR(field.centre_circle_diameter + line, row.circle, 1e-9);
    EXPECT_GE(field.border_strip_width - line / 2, 1 - 1e-9) << row.name;
    EXPECT_NEAR(scene.goals->post_distance - scene.goals->post_diameter, row.goal_width, 1e-9);
    const double opening = scene.goals->crossbar_height - scene.goals->post_diameter / 2;
    EXPECT_GE(opening, row.min_height) << row.name;
    EXPECT_LE(opening, row.max_height) << row.name;
  }
}

TEST(SceneFile, ReadsAnEmptyScene) {
  const SceneFile scene =
      SceneFile::load(std::filesystem::path(NAO_SOURCE_DIR) / "data/scenes/empty.yaml");
  EXPECT_EQ(scene.name, "empty");
  EXPECT_FALSE(scene.field || scene.goals || scene.ball);
}

TEST(SceneFile, RefusesWhatItDoesNotUnderstand) {
  const std::string ball = "name: x\nball: {radius: 0.05, mass: 0.045, position: [0, 0]";
  expect_refused("", "must be a map");
  expect_refused("- 1\n", "must be a map");
  expect_refused("name: [", "not YAML");
  expect_refused("ball: {}\n", "lacks \"name\"");
  expect_refused("name: x\nbal: {}\n", "bal is unknown");
  expect_refused(ball + ", colour: red}", "ball.colour is unknown");
  expect_refused("name: x\nball: {radius: -1, mass: 1, position: [0, 0]}", "radius");
  expect_refused("name: x\nball: {radius: .nan, mass: 1, position: [0, 0]}", "radius");
  expect_refused("name: x\nball: {radius: big, mass: 1, position: [0, 0]}", "radius");
  expect_refused("name: x\nball: {radius: 1, mass: 1, position: [0]}", "position");
  expect_refused("name: x\nball: {radius: 1, mass: 1, position: [0, 1e9]}", "position");
  expect_refused("name: x\nball: {radius: 1, radius: 1, mass: 1, position: [0, 0]}", "twice");
  expect_refused(
      "name: x\ngoals: {post_diameter: 0.1, post_distance: 1, post_offset: 0, crossbar_height: 1, "
      "depth: 1}",
      "need a field");
}

TEST(SceneFile, NamesAFileThatIsMissing) {
  EXPECT_THROW(SceneFile::load("/nonexistent/soccer.yaml"), ConfigError);
}

}  // namespace
}  // namespace nao
