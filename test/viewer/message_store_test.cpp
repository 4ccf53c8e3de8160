#include "viewer/message_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <naolcm/stop_command_t.hpp>

#include "viewer/time_plots.h"
#include "viewer/viewer_options.h"

#include "common/error.h"

namespace nao::viewer {
namespace {

template <class Message>
std::vector<uint8_t> encode(const Message& message) {
  std::vector<uint8_t> data(message.getEncodedSize());
  message.encode(data.data(), 0, static_cast<int>(data.size()));
  return data;
}

naolcm::robot_state_t some_state() {
  naolcm::robot_state_t state{};
  state.utime = 123;
  state.num_joints = 2;
  state.joint_names = {"HeadYaw", "LHand"};
  state.joint_position = {0.5, -0.25};
  state.joint_velocity = {0, 1};
  state.center_of_pressure_in_odometry[1] = NAN;
  state.num_support_corners = 1;
  state.support_corner_in_odometry = {{3, 4}};
  return state;
}

TEST(MessageStore, KeepsTheNewestOfEachKind) {
  MessageStore store("NAO");
  naolcm::robot_state_t state = some_state();
  auto data = encode(state);
  EXPECT_TRUE(store.receive("NAO_ROBOT_STATE", data.data(), static_cast<int>(data.size()), 1));
  state.utime = 456;
  data = encode(state);
  EXPECT_TRUE(store.receive("NAO_ROBOT_STATE", data.data(), static_cast<int>(data.size()), 2));
  ASSERT_TRUE(store.robot_state());
  EXPECT_EQ(store.robot_state()->message.utime, 456);
  EXPECT_EQ(store.robot_state()->time, 2);
  EXPECT_TRUE(store.receive("OTHER_ROBOT_STATE", data.data(), static_cast<int>(data.size()), 3));
  EXPECT_EQ(store.robot_state()->time, 2) << "the other state is of another robot";
}

TEST(MessageStore, RejectsAMessageOfAnotherTypeAndKeepsTheLastValidOne) {
  MessageStore store("NAO");
  auto data = encode(some_state());
  store.receive("NAO_ROBOT_STATE", data.data(), static_cast<int>(data.size()), 1);
  const auto wrong = encode(naolcm::stop_command_t{});
  EXPECT_FALSE(store.receive("NAO_ROBOT_STATE", wrong.data(), static_cast<int>(wrong.size()), 2));
  EXPECT_FALSE(store.receive("NAO_ROBOT_STATE", data.data(), 20, 2));  // truncated
  EXPECT_EQ(store.robot_state()->time, 1);
}

TEST(MessageStore, HasABoundedSize) {
  MessageStore store("NAO");
  for (int i = 0; i < 1000; ++i) {
    naolcm::command_result_t result{};
    result.command_id = i;
    auto data = encode(result);
    store.receive("NAO_COMMAND_RESULT", data.data(), static_cast<int>(data.size()), i);
    naolcm::daemon_status_t status{};
    status.process_id = i;
    data = encode(status);
    store.receive(kDaemonStatusChannel, data.data(), static_cast<int>(data.size()), i);
    store.receive("CHANNEL_" + std::to_string(i), data.data(), static_cast<int>(data.size()), i);
  }
  EXPECT_LE(store.results().size(), 100u);
  EXPECT_EQ(store.results().back().message.command_id, 999);
  EXPECT_LE(store.programs().size(), 50u);
  EXPECT_LE(store.raw().size(), 200u);
}

TEST(MessageStore, ListsARepeatedResultOnce) {
  MessageStore store("NAO");
  naolcm::command_result_t result{};
  result.source = "nao.1";
  for (const int8_t status : {result.STATUS_ACCEPTED, result.STATUS_ACCEPTED,
                              result.STATUS_ACCEPTED, result.STATUS_DONE}) {
    result.status = status;
    const auto data = encode(result);
    store.receive("NAO_COMMAND_RESULT", data.data(), static_cast<int>(data.size()), 1);
  }
  ASSERT_EQ(store.results().size(), 2u);
  EXPECT_EQ(store.results().back().message.status, naolcm::command_result_t::STATUS_DONE);
}

TEST(TimePlots, KeepTheLastSecondsOfTheSelectedFields) {
  TimePlots plots(2);
  plots.add("NAO_ROBOT_STATE", "joint_position[HeadYaw]");
  plots.add("NAO_ROBOT_STATE", "joint_position[HeadYaw]");  // only once
  plots.add("NAO_ROBOT_STATE", "center_of_pressure_in_odometry[1]");
  ASSERT_EQ(plots.series().size(), 2u);
  naolcm::robot_state_t state = some_state();
  for (int i = 0; i <= 50; ++i) {
    state.joint_position[0] = i;
    const auto data = encode(state);
    plots.receive("NAO_ROBOT_STATE", data.data(), static_cast<int>(data.size()), 0.1 * i);
  }
  EXPECT_NEAR(static_cast<double>(plots.series()[0].points.size()), 21, 1);
  EXPECT_EQ(plots.series()[0].points.back().value, 50);
  EXPECT_TRUE(plots.series()[1].points.empty());  // not finite
  const auto data = encode(state);
  plots.receive("NAO_ROBOT_STATE", data.data(), static_cast<int>(data.size()), 0);
  EXPECT_EQ(plots.series()[0].points.size(), 1u);  // time ran backwards
}

TEST(ViewerOptions, RejectContradictions) {
  const auto is_valid = [](const auto& change) {
    ViewerOptions options;
    change(options);
    try {
      options.validate();
      return true;
    } catch (const ConfigError&) {
      return false;
    }
  };
  EXPECT_TRUE(is_valid([](ViewerOptions&) {}));
  EXPECT_FALSE(is_valid([](ViewerOptions& options) { options.width = 10; }));
  EXPECT_FALSE(is_valid([](ViewerOptions& options) { options.is_offscreen = true; }));
  EXPECT_FALSE(is_valid([](ViewerOptions& options) { options.supersample = 2; }));
  EXPECT_FALSE(is_valid([](ViewerOptions& options) { options.view = {1, 2}; }));
  EXPECT_FALSE(is_valid([](ViewerOptions& options) { options.plots = {"NAO_ROBOT_STATE"}; }));
  EXPECT_TRUE(is_valid([](ViewerOptions& options) {
    options.screenshot = "a.png";
    options.is_offscreen = true;
    options.without_panels = true;
    options.supersample = 2;
    options.plots = {"NAO_ROBOT_STATE:utime"};
  }));
}

}  // namespace
}  // namespace nao::viewer
