#include "tools/nao/joint_arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.h"

namespace nao {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

TEST(JointArguments, ReadsChangesAndTargets) {
  const JointArguments changes = parse_joint_arguments({"HeadYaw", "+0.3", "HeadPitch", "-0.1"});
  EXPECT_TRUE(changes.is_relative);
  EXPECT_THAT(changes.names, ElementsAre("HeadYaw", "HeadPitch"));
  EXPECT_THAT(changes.positions, ElementsAre(0.3, -0.1));

  const JointArguments targets = parse_joint_arguments({"LHand", "=-0.5"});
  EXPECT_FALSE(targets.is_relative);
  EXPECT_THAT(targets.positions, ElementsAre(-0.5));
}

TEST(JointArguments, ReadsDegrees) {
  EXPECT_THAT(parse_joint_arguments({"HeadYaw", "+90deg"}).positions,
              ElementsAre(DoubleNear(1.5707963, 1e-7)));
}

TEST(JointArguments, RejectsInvalidAngles) {
  for (const char* text : {"", "0.3", "+", "=", "+nan", "=inf", "+1e999", "+0.3m", "left"}) {
    EXPECT_THROW(parse_joint_arguments({"HeadYaw", text}), ConfigError) << text;
  }
}

TEST(JointArguments, RejectsIncompleteAndMixedPairs) {
  EXPECT_THROW(parse_joint_arguments({}), ConfigError);
  EXPECT_THROW(parse_joint_arguments({"HeadYaw"}), ConfigError);
  EXPECT_THROW(parse_joint_arguments({"HeadYaw", "+0.3", "HeadPitch", "=0.1"}), ConfigError);
}

}  // namespace
}  // namespace nao
