#include "daemons/vision/field_model.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/error.h"

namespace nao::vision {
namespace {

SceneFile soccer() {
  return SceneFile::find("soccer");
}

TEST(FieldModel, NeedsAField) {
  EXPECT_THROW(FieldModel(SceneFile::find("empty")), ConfigError);
}

TEST(FieldModel, LooksTheSameTurnedByHalfATurn) {
  const FieldModel field(soccer());
  for (const FieldCrossing& crossing : field.crossings()) {
    EXPECT_TRUE(std::any_of(
        field.crossings().begin(), field.crossings().end(), [&](const FieldCrossing& other) {
          return other.kind == crossing.kind && (other.position + crossing.position).norm() < 1e-9;
        }));
  }
  for (const FieldLine& line : field.lines()) {
    EXPECT_TRUE(
        std::any_of(field.lines().begin(), field.lines().end(), [&](const FieldLine& other) {
          return ((other.from + line.from).norm() < 1e-9 && (other.to + line.to).norm() < 1e-9) ||
                 ((other.from + line.to).norm() < 1e-9 && (other.to + line.from).norm() < 1e-9);
        }));
  }
}

TEST(FieldModel, HasTheLinesAndPostsOfTheScene) {
  const FieldModel field(soccer());
  // Halfway line, four outer lines, three of each of the four areas.
  EXPECT_EQ(field.lines().size(), 17u);
  // Four corners, two at the halfway line, two L and two T of each area.
  EXPECT_EQ(field.crossings().size(), 22u);
  ASSERT_EQ(field.goal_posts().size(), 4u);
  EXPECT_NEAR(std::abs(field.goal_posts()[0].x()), 4.525, 1e-9);
  EXPECT_NEAR(std::abs(field.goal_posts()[0].y()), 0.8, 1e-9);
  EXPECT_DOUBLE_EQ(field.circle_radius(), 0.75);
}

}  // namespace
}  // namespace nao::vision
