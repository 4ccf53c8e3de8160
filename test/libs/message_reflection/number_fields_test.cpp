#include "message_reflection/number_fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <naolcm/command_result_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/world_truth_t.hpp>

namespace nao {
namespace {

template <class Message>
std::vector<uint8_t> encode(const Message& message) {
  std::vector<uint8_t> data(message.getEncodedSize());
  message.encode(data.data(), 0, static_cast<int>(data.size()));
  return data;
}

std::map<std::string, NumberField> numbers(const std::vector<uint8_t>& data) {
  std::map<std::string, NumberField> numbers;
  EXPECT_TRUE(visit_numbers(data, [&](const NumberField& field) { numbers[field.path] = field; }));
  return numbers;
}

TEST(NumberFields, LabelArrayElementsByTheStringArrayOfTheSameLength) {
  naolcm::robot_state_t state{};
  state.utime = 123;
  state.num_joints = 2;
  state.joint_names = {"HeadYaw", "LHand"};
  state.joint_position = {0.5, -0.25};
  state.joint_velocity = {0, 1};
  state.center_of_pressure_in_odometry[1] = NAN;
  state.num_support_corners = 1;
  state.support_corner_in_odometry = {{3, 4}};
  const auto fields = numbers(encode(state));
  EXPECT_EQ(fields.at("utime").value, 123);
  EXPECT_EQ(fields.at("joint_position[HeadYaw]").value, 0.5);
  EXPECT_EQ(fields.at("joint_velocity[LHand]").value, 1);
  EXPECT_EQ(fields.at("support_corner_in_odometry[0][1]").value, 4);
  EXPECT_TRUE(std::isnan(fields.at("center_of_pressure_in_odometry[1]").value));
}

TEST(NumberFields, IncludeNestedStructs) {
  naolcm::world_truth_t truth{};
  truth.num_robots = 1;
  truth.robots.resize(1);
  truth.robots[0].position_torso_in_world[2] = 0.32;
  truth.num_contacts = 1;
  truth.contacts.resize(1);
  truth.contacts[0].force_on_a_in_world[2] = 26;
  const auto fields = numbers(encode(truth));
  EXPECT_EQ(fields.at("robots[0].position_torso_in_world[2]").value, 0.32);
  EXPECT_EQ(fields.at("contacts[0].force_on_a_in_world[2]").value, 26);
}

TEST(NumberFields, NameTheConstantOfAnEnumeration) {
  naolcm::command_result_t result{};
  result.status = naolcm::command_result_t::STATUS_DONE;
  result.command_kind = 100;
  const auto fields = numbers(encode(result));
  EXPECT_EQ(fields.at("status").constant, "STATUS_DONE");
  EXPECT_EQ(fields.at("status").value, naolcm::command_result_t::STATUS_DONE);
  EXPECT_EQ(fields.at("command_kind").constant, "") << "no constant has this value";
  EXPECT_EQ(fields.at("command_id").constant, "");
}

TEST(NumberFields, UnknownAndTruncatedMessagesGiveNone) {
  const auto fail = [](const NumberField&) { FAIL(); };
  const std::vector<uint8_t> garbage(100, 7);
  EXPECT_FALSE(visit_numbers(garbage, fail));
  EXPECT_FALSE(visit_numbers(std::span(garbage).first(3), fail));
  const std::vector<uint8_t> whole = encode(naolcm::robot_state_t{});
  EXPECT_FALSE(visit_numbers(std::span(whole).first(whole.size() - 1), fail));
}

}  // namespace
}  // namespace nao
