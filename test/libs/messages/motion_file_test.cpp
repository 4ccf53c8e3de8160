#include "messages/motion_file.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao {
namespace {

NamedMotion two_poses() {
  const double nan = std::nan("");
  NamedMotion motion;
  motion.name = "nod";
  motion.start = "StandInit";
  motion.num_repetitions = 3;
  motion.joint_names = {"HeadYaw", "HeadPitch"};
  motion.keyframes = {{0.5, 0, {0.1, 0.2}, {nan, 1}}, {0.7, 0.2, {nan, -0.2}, {nan, nan}}};
  return motion;
}

TEST(MotionFile, IsTheSameAfterItsMessage) {
  const auto received = from_message(to_message(two_poses()));
  ASSERT_TRUE(received);
  EXPECT_EQ(received->name, "nod");
  EXPECT_EQ(received->start, "StandInit");
  EXPECT_EQ(received->num_repetitions, 3);
  ASSERT_EQ(received->keyframes.size(), 2u);
  EXPECT_EQ(received->keyframes[0].position, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(received->keyframes[0].stiffness[1], 1);
  EXPECT_TRUE(std::isnan(received->keyframes[1].position[0]));
  EXPECT_EQ(received->keyframes[1].position[1], -0.2);
  EXPECT_EQ(received->keyframes[1].pause, 0.2);
}

TEST(MotionFile, RefusesListsThatDoNotMatch) {
  naolcm::keyframe_motion_t message = to_message(two_poses());
  message.num_values = 3;
  message.joint_position.resize(3);
  message.joint_stiffness.resize(3);
  EXPECT_FALSE(from_message(message));
  message = to_message(two_poses());
  message.num_joints = 0;
  message.joint_names.clear();
  EXPECT_FALSE(from_message(message));
}

TEST(MotionFile, RefusesAnUnknownOperation) {
  naolcm::motion_file_command_t message = to_message(MotionFileCommand{});
  EXPECT_TRUE(from_message(message));
  message.operation = 5;
  EXPECT_FALSE(from_message(message));
  message.operation = -1;
  EXPECT_FALSE(from_message(message));
}

TEST(MotionFile, NamesAreFileNamesAndNothingElse) {
  EXPECT_TRUE(is_motion_name("Wave-2_left"));
  EXPECT_TRUE(is_motion_name(std::string(40, 'a')));
  EXPECT_FALSE(is_motion_name(std::string(41, 'a')));
  for (const char* name : {"", ".", "..", "a/b", "../a", "a.yaml", "a b", "a\n", "ä", "a\\b"}) {
    EXPECT_FALSE(is_motion_name(name)) << name;
  }
  EXPECT_FALSE(is_motion_name(std::string("a\0b", 3)));
}

}  // namespace
}  // namespace nao
