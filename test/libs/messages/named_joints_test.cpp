#include "messages/named_joints.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace nao {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

const std::vector<std::string> kRobotJoints = {"HeadYaw", "HeadPitch", "LHand"};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(NamedJoints, PutsValuesInTheRobotsOrder) {
  std::vector<double> position;
  std::vector<double> velocity;
  EXPECT_EQ(
      read_named_joints(kRobotJoints, {"LHand", "HeadYaw", "HeadPitch"},
                        {{"position", {3, 1, 2}, position}, {"velocity", {6, 4, 5}, velocity}}),
      std::nullopt);
  EXPECT_THAT(position, ElementsAre(1, 2, 3));
  EXPECT_THAT(velocity, ElementsAre(4, 5, 6));
}

TEST(NamedJoints, KeepsJointsThatASubsetDoesNotName) {
  std::vector<double> position = {1, 2, 3};
  EXPECT_EQ(read_named_joints(kRobotJoints, {"HeadPitch"}, {{"position", {5}, position}},
                              JointCoverage::kSubset),
            std::nullopt);
  EXPECT_THAT(position, ElementsAre(1, 5, 3));
}

/** Reads positions and stiffness in [0, 1]; with a fault the results must not change. */
std::optional<Reason> read(const std::vector<std::string>& names,
                           const std::vector<double>& position,
                           const std::vector<double>& stiffness,
                           JointCoverage coverage = JointCoverage::kAll) {
  std::vector<double> read_position = {7, 8, 9};
  std::vector<double> read_stiffness = {7, 8, 9};
  auto fault =
      read_named_joints(kRobotJoints, names,
                        {{.quantity = "position", .values = position, .result = read_position},
                         {.quantity = "stiffness",
                          .values = stiffness,
                          .result = read_stiffness,
                          .lower = 0,
                          .upper = 1,
                          .allows_nan = true}},
                        coverage);
  if (fault) {
    EXPECT_THAT(read_position, ElementsAre(7, 8, 9));
    EXPECT_THAT(read_stiffness, ElementsAre(7, 8, 9));
  }
  return fault;
}

TEST(NamedJoints, RefusesAnUnknownJoint) {
  EXPECT_THAT(read({"HeadYaw", "Tail", "LHand"}, {1, 2, 3}, {1, 1, 1}),
              Optional(Reason("joint-unknown", {"\"Tail\""})));
}

TEST(NamedJoints, RefusesAJointThatIsListedTwice) {
  EXPECT_THAT(read({"HeadYaw", "HeadPitch", "HeadYaw"}, {1, 2, 3}, {1, 1, 1}),
              Optional(Reason("joint-repeated", {"HeadYaw"})));
}

TEST(NamedJoints, RefusesAMissingJointUnlessASubsetIsAllowed) {
  EXPECT_THAT(read({"HeadYaw", "LHand"}, {1, 3}, {1, 1}),
              Optional(Reason("joint-missing", {"HeadPitch"})));
  EXPECT_EQ(read({"HeadYaw", "LHand"}, {1, 3}, {1, 1}, JointCoverage::kSubset), std::nullopt);
  EXPECT_EQ(read({}, {}, {}, JointCoverage::kSubset), std::nullopt);
}

TEST(NamedJoints, RefusesListsOfUnequalLengths) {
  EXPECT_THAT(read({"HeadYaw", "HeadPitch", "LHand"}, {1, 2, 3}, {1, 1}),
              Optional(Reason("joint-lists-unequal", {"3", "stiffness", "2"})));
}

TEST(NamedJoints, RefusesWhatIsNotFinite) {
  const std::vector<std::string>& names = kRobotJoints;
  EXPECT_THAT(read(names, {1, kNan, 3}, {1, 1, 1}),
              Optional(Reason("joint-value-not-finite", {"HeadPitch", "position"})));
  EXPECT_THAT(read(names, {1, -kInfinity, 3}, {1, 1, 1}),
              Optional(Reason("joint-value-not-finite", {"HeadPitch", "position"})));
  EXPECT_THAT(read(names, {1, 2, 3}, {1, 1, kInfinity}),
              Optional(Reason("joint-value-not-finite", {"LHand", "stiffness"})));
}

TEST(NamedJoints, AcceptsNanWhereItHasAMeaning) {
  EXPECT_EQ(read(kRobotJoints, {1, 2, 3}, {1, kNan, 1}), std::nullopt);
}

TEST(NamedJoints, RefusesAValueOutOfItsRange) {
  EXPECT_THAT(
      read(kRobotJoints, {1, 2, 3}, {0, 1, 1.5}),
      Optional(Reason("joint-value-out-of-range", {"LHand", "stiffness", "1.5", "0", "1"})));
}

}  // namespace
}  // namespace nao
