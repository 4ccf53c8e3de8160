#include "phone-gateway/server/bus/bus_messages.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/error.h"
#include "test/phone-gateway/server/core/test_robot.h"

namespace nao::gateway {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

naolcm::robot_state_t make_state() {
  naolcm::robot_state_t state{};
  state.utime = 5;
  state.num_joints = 4;
  state.joint_names = {"LHand", "HeadPitch", "LShoulderRoll", "HeadYaw"};
  state.joint_position = {4, 2, 3, 1};
  state.orientation_torso_in_odometry[0] = 1;
  state.position_torso_in_odometry[2] = 0.3;
  return state;
}

TEST(RobotStateReader, PutsJointsInTheOrderOfTheDescription) {
  const RobotStateReader reader(make_test_robot());
  const RobotSnapshot robot = reader.read(make_state());
  EXPECT_EQ(robot.joint_position, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(robot.torso_position[2], 0.3);
}

TEST(RobotStateReader, RefusesUnknownJointsAndNumbersThatAreNotFinite) {
  const RobotStateReader reader(make_test_robot());
  auto unknown = make_state();
  unknown.joint_names[0] = "Tail";
  EXPECT_THROW((void)reader.read(unknown), Error);
  auto broken = make_state();
  broken.joint_position[2] = kNaN;
  EXPECT_THROW((void)reader.read(broken), Error);
  auto twisted = make_state();
  twisted.orientation_torso_in_odometry[1] = kNaN;
  EXPECT_THROW((void)reader.read(twisted), Error);
}

TEST(RobotStateReader, RefusesARepeatedJointThatHidesAMissingOne) {
  const RobotStateReader reader(make_test_robot());
  auto repeated = make_state();
  repeated.joint_names = {"LHand", "LHand", "LShoulderRoll", "HeadYaw"};
  EXPECT_THROW((void)reader.read(repeated), Error) << "HeadPitch would be 0";
  auto missing = make_state();
  missing.num_joints = 3;
  missing.joint_names.resize(3);
  missing.joint_position.resize(3);
  EXPECT_THROW((void)reader.read(missing), Error);
}

TEST(ReadMotionState, WritesAnOpenEndAsNegativeProgress) {
  naolcm::motion_state_t motion{};
  motion.mode = motion.MODE_WALKING;
  motion.command_kind = motion.COMMAND_KIND_WALK;
  motion.command_progress = kNaN;
  EXPECT_LT(read_motion_state(motion).progress, 0);
  EXPECT_EQ(read_motion_state(motion).activity->kind(), naoremote::COMMAND_KIND_WALK);
  motion.command_kind = motion.COMMAND_KIND_POSTURE;
  motion.command_name = "Crouch";
  motion.command_progress = 0.5;
  EXPECT_EQ(read_motion_state(motion).progress, 0.5);
  motion.stiffness = kNaN;
  EXPECT_THROW((void)read_motion_state(motion), Error);
}

TEST(ReadMotionState, HasTheKindAndNameOfTheActivity) {
  naolcm::motion_state_t motion{};
  motion.mode = motion.MODE_HOLDING;
  motion.command_kind = motion.COMMAND_KIND_NONE;
  EXPECT_FALSE(read_motion_state(motion).activity.has_value());
  motion.command_name = "get-up";
  EXPECT_EQ(read_motion_state(motion).activity->kind(), naoremote::COMMAND_KIND_NONE);
  EXPECT_EQ(read_motion_state(motion).activity->name(), "get-up");
  motion.command_kind = motion.COMMAND_KIND_STOP;
  EXPECT_EQ(read_motion_state(motion).activity->kind(), naoremote::COMMAND_KIND_STOP);
  motion.needs_help = 1;
  EXPECT_TRUE(read_motion_state(motion).activity->needs_help());
}

TEST(ReadMotionState, RefusesUnknownModesAndKinds) {
  naolcm::motion_state_t motion{};
  motion.mode = motion.MODE_NO_ROBOT + 1;
  EXPECT_THROW((void)read_motion_state(motion), Error);
  motion.mode = motion.MODE_HOLDING;
  motion.command_kind = motion.COMMAND_KIND_STOP + 1;
  EXPECT_THROW((void)read_motion_state(motion), Error);
}

TEST(ReadImage, TakesJpegsOnly) {
  naolcm::image_t image{};
  image.camera = "bottom";
  image.width = 320;
  image.height = 240;
  image.format = "jpeg";
  image.size_bytes = 3;
  image.data = {1, 2, 3};
  EXPECT_EQ(read_image(image).camera, "bottom");
  EXPECT_EQ(read_image(image).jpeg, "\1\2\3");
  image.format = "png";
  EXPECT_THROW((void)read_image(image), Error);
}

TEST(ReadResult, ForwardsTheReasonWithItsArguments) {
  naolcm::command_result_t message{};
  message.source = "phone.1.2";
  message.command_id = 7;
  message.command_kind = message.COMMAND_KIND_POSTURE;
  message.status = message.STATUS_REFUSED;
  message.reason_code = "no-path";
  message.num_reason_arguments = 2;
  message.reason_arguments = {"Sit", "Stand"};
  message.reason = "There is no path.";
  const CommandResult result = read_result(message);
  EXPECT_EQ(result.id, 7);
  EXPECT_EQ(result.kind, CommandKind::kPosture);
  EXPECT_EQ(result.status, ResultStatus::kRefused);
  EXPECT_EQ(result.reason.code, "no-path");
  EXPECT_EQ(result.reason.arguments, (std::vector<std::string>{"Sit", "Stand"}));
  EXPECT_EQ(result.sentence, "There is no path.");
  message.status = message.STATUS_FAILED + 1;
  EXPECT_THROW((void)read_result(message), Error);
}

}  // namespace
}  // namespace nao::gateway
