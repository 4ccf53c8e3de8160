#include "message_reflection/message_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <naolcm/image_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <random>

#include "inspection/message_json.h"
#include "message_reflection/message_types.h"
#include "tools/nao-tools/log_statistics.h"
#include "tools/nao-tools/message_table.h"

namespace nao {
namespace {

template <class Message>
std::vector<uint8_t> encoded(const Message& message) {
  std::vector<uint8_t> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

naolcm::joint_command_t two_joints() {
  naolcm::joint_command_t command{};
  command.utime = 20000;
  command.tick = 2;
  command.num_joints = 2;
  command.joint_names = {"HeadYaw", "HeadPitch"};
  command.joint_position = {0.5, -0.25};
  command.joint_velocity = command.joint_torque = {0, 0};
  command.joint_kp = command.joint_kd = {0, 0};
  command.joint_stiffness = {1, std::numeric_limits<double>::quiet_NaN()};
  return command;
}

naolcm::world_truth_t truth_with_contacts(int num_contacts) {
  naolcm::world_truth_t truth{};
  truth.scene = "soccer, \"empty\"";
  truth.num_contacts = num_contacts;
  truth.contacts.resize(num_contacts);
  for (auto& contact : truth.contacts) contact.force_on_a_in_world[2] = 25;
  return truth;
}

TEST(MessageWalk, MakesJsonWithTheNamesOfTheLcmFile) {
  EXPECT_EQ(message_to_json(*find_message_layout("joint_command_t"), encoded(two_joints())),
            R"({"utime":20000,"tick":2,"num_joints":2,"joint_names":["HeadYaw","HeadPitch"],)"
            R"("joint_position":[0.5,-0.25],"joint_velocity":[0.0,0.0],"joint_torque":[0.0,0.0],)"
            R"("joint_kp":[0.0,0.0],"joint_kd":[0.0,0.0],"joint_stiffness":[1.0,null]})");
}

TEST(MessageWalk, MakesColumnsNamedByJoint) {
  MessageTable table(*find_message_layout("joint_command_t"));
  const auto bytes = encoded(two_joints());
  ASSERT_TRUE(table.see(bytes));
  EXPECT_EQ(table.heading(),
            "utime,tick,num_joints,joint_names[0],joint_names[1],joint_position[HeadYaw],"
            "joint_position[HeadPitch],joint_velocity[HeadYaw],joint_velocity[HeadPitch],"
            "joint_torque[HeadYaw],joint_torque[HeadPitch],joint_kp[HeadYaw],joint_kp[HeadPitch],"
            "joint_kd[HeadYaw],joint_kd[HeadPitch],joint_stiffness[HeadYaw],"
            "joint_stiffness[HeadPitch]");
  EXPECT_EQ(table.row(bytes), "20000,2,2,HeadYaw,HeadPitch,0.5,-0.25,0,0,0,0,0,0,0,0,1,nan");
}

TEST(MessageWalk, ATableHasColumnsForTheLongestList) {
  MessageTable table(*find_message_layout("world_truth_t"));
  const auto few = encoded(truth_with_contacts(0));
  const auto many = encoded(truth_with_contacts(2));
  ASSERT_TRUE(table.see(few));
  ASSERT_TRUE(table.see(many));
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  EXPECT_NE(table.heading().find("contacts[1].force_on_a_in_world[2]"), std::string::npos);
  // The scene's name contains one more comma.
  EXPECT_EQ(commas(table.row(few)), commas(table.heading()) + 1);
  EXPECT_EQ(commas(table.row(many)), commas(table.heading()) + 1);
  EXPECT_NE(table.row(few).find("\"soccer, \"\"empty\"\"\""), std::string::npos);
}

TEST(MessageWalk, WritesImagesAsBase64) {
  naolcm::image_t image{};
  image.data = {'f', 'o', 'o', 'b'};
  image.size_bytes = 4;
  const auto json = message_to_json(*find_message_layout("image_t"), encoded(image));
  ASSERT_TRUE(json);
  EXPECT_NE(json->find("\"data\":\"Zm9vYg==\""), std::string::npos) << *json;
}

TEST(MessageWalk, SchemasStateTheUnits) {
  const std::string schema = json_schema_of(*find_message_layout("walk_command_t"));
  EXPECT_NE(schema.find("\"vx\":{\"type\":\"number\""), std::string::npos) << schema;
  EXPECT_NE(schema.find("m/s"), std::string::npos) << schema;
}

TEST(MessageWalk, RejectsTruncatedMessages) {
  std::mt19937 random(1);
  for (const auto& whole : {encoded(two_joints()), encoded(truth_with_contacts(3))}) {
    const MessageType* type = find_message_type(whole.data(), static_cast<int>(whole.size()));
    ASSERT_NE(type, nullptr);
    const MessageLayout& layout = *find_message_layout(type->name);
    for (size_t size = 0; size < whole.size(); ++size) {
      EXPECT_FALSE(message_to_json(layout, std::span(whole).first(size))) << size;
    }
    for (int round = 0; round < 2000; ++round) {
      auto damaged = whole;
      for (int i = 0; i < 3; ++i) {
        damaged[8 + random() % (damaged.size() - 8)] = static_cast<uint8_t>(random());
      }
      // Must neither crash nor read beyond the end; the result is unspecified.
      (void)message_to_json(layout, damaged);
      MessageTable table(layout);
      if (table.see(damaged)) {
        EXPECT_FALSE(table.row(damaged).empty());
      }
    }
  }
}

TEST(LogStatistics, CountsLostTicksAndUnknownMessages) {
  LogStatistics statistics;
  for (const int64_t tick : {10, 11, 14, 13}) {
    naolcm::joint_command_t command = two_joints();
    command.tick = tick;
    statistics.add({tick, tick * 10000, "NAO_JOINT_COMMAND", encoded(command)});
  }
  statistics.add({0, 200000, "OTHER", {1, 2, 3}});
  const LoggedChannel& channel = statistics.channels().at("NAO_JOINT_COMMAND");
  EXPECT_EQ(channel.type, "joint_command_t");
  EXPECT_EQ(channel.num_missing_ticks(), 1);
  EXPECT_DOUBLE_EQ(channel.longest_gap, 0.03);
  EXPECT_EQ(statistics.channels().at("OTHER").num_undecodable, 1);
}

}  // namespace
}  // namespace nao
