#include "message_reflection/message_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <naolcm/command_result_t.hpp>
#include <naolcm/motion_state_t.hpp>

#include "message_reflection/message_types.h"

namespace nao {
namespace {

FieldLayout field(const std::string& message, const std::string& name) {
  const std::vector<FieldLayout>& fields = find_message_layout(message)->fields;
  return *std::find_if(fields.begin(), fields.end(),
                       [&](const FieldLayout& layout) { return layout.name == name; });
}

TEST(MessageLayout, EveryTypeHasALayout) {
  for (const MessageType& type : message_types()) {
    EXPECT_NE(find_message_layout(type.name), nullptr) << type.name;
  }
  EXPECT_EQ(message_layouts().size(), message_types().size());
  EXPECT_EQ(find_message_layout("unknown_t"), nullptr);
}

TEST(MessageLayout, DescribesFieldsAsTheLcmFileDoes) {
  const FieldLayout position = field("joint_command_t", "joint_position");
  EXPECT_EQ(position.kind, FieldKind::kDouble);
  EXPECT_EQ(position.dimensions, std::vector<std::string>{"num_joints"});
  EXPECT_THAT(field("walk_command_t", "vx").description, testing::HasSubstr("m/s"));
  EXPECT_EQ(field("world_truth_t", "robots").type, "robot_truth_t");
}

TEST(MessageLayout, NamesTheValuesOfEnumerations) {
  using naolcm::command_result_t;
  using naolcm::motion_state_t;
  const FieldLayout status = field("command_result_t", "status");
  EXPECT_EQ(*find_constant_name(status, command_result_t::STATUS_DONE), "STATUS_DONE");
  EXPECT_EQ(status.constants.size(), 5u);
  EXPECT_EQ(find_constant_name(status, 100), nullptr);
  const FieldLayout kind = field("motion_state_t", "command_kind");
  EXPECT_EQ(*find_constant_name(kind, motion_state_t::COMMAND_KIND_NONE), "COMMAND_KIND_NONE");
  EXPECT_EQ(*find_constant_name(kind, motion_state_t::COMMAND_KIND_STOP), "COMMAND_KIND_STOP");
}

TEST(MessageLayout, AConstantBelongsToTheFieldOfItsOwnType) {
  // PENALTY_LEFT_FIELD is a value of `penalty` (int8_t), not of `penalty_left` (double, s).
  EXPECT_TRUE(field("player_t", "penalty_left").constants.empty());
  EXPECT_NE(find_constant_name(field("player_t", "penalty"), 1), nullptr);
  EXPECT_TRUE(field("command_result_t", "utime").constants.empty());
}

}  // namespace
}  // namespace nao
