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
