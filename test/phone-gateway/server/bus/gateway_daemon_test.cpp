#include "phone-gateway/server/bus/gateway_daemon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/match_state_t.hpp>

#include "common/wall_clock.h"
#include "test/phone-gateway/server/core/test_robot.h"
#include "test/support/fake_motion.h"

namespace nao::gateway {
namespace {

naoremote::RobotDescription named(const std::string& name) {
  naoremote::RobotDescription robot = make_test_robot();
  robot.set_name(name);
  return robot;
}

/** A gateway of two robots on a bus inside the process, and a client of its core. */
class GatewayDaemonTest : public testing::Test {
 protected:
  GatewayDaemonTest()
      : first_(bus_, kJoints, "NAO1"),
        second_(bus_, kJoints, "NAO2"),
        daemon_(bus_, {named("NAO1"), named("NAO2")}, GatewayLimits{}, "secret") {
    run();
    const auto wake = [] {};
    client_ = daemon_.core().open({"127.0.0.1", "tcp", true}, wake, monotonic_seconds());
    naoremote::Request request;
    request.mutable_connect()->set_protocol_version(1);
    request.mutable_connect()->set_robot("NAO2");
    ask(request);
    request.mutable_take_control();
    ask(request);
  }

  void run() {
    for (int i = 0; i < 10; ++i) {
      first_.step();
      second_.step();
      while (bus_.handle_for(0)) {
      }
      daemon_.step(monotonic_seconds());
    }
  }

  /** Sends a request and takes all messages. */
  void ask(const naoremote::Request& request) {
    (void)daemon_.core().receive(client_, request.SerializeAsString(), monotonic_seconds());
    run();
    while (const auto bytes = daemon_.core().next(client_, true, monotonic_seconds()).message) {
      messages_.emplace_back();
      ASSERT_TRUE(messages_.back().ParseFromString(*bytes));
    }
  }

  const std::vector<std::string> kJoints = {"HeadYaw", "HeadPitch", "LShoulderRoll", "LHand"};
  Bus bus_{"memq://"};
  FakeMotion first_;
  FakeMotion second_;
  GatewayDaemon daemon_;
  uint32_t client_ = 0;
  std::vector<naoremote::ServerMessage> messages_;
};

TEST_F(GatewayDaemonTest, CommandsReachTheRobotThatIsDrivenAndItsResultsTheClient) {
  naoremote::Request request;
  request.mutable_go_to_posture()->set_posture("Crouch");
  ask(request);
  EXPECT_TRUE(first_.commands().empty());
  EXPECT_EQ(second_.commands(), std::vector<std::string>{"posture"});
  EXPECT_EQ(messages_.back().notice().status(), naoremote::Notice::DONE);
  request.mutable_walk_turn()->set_vx(0.1);
  ask(request);
  EXPECT_TRUE(first_.walks().empty());
  EXPECT_FALSE(second_.walks().empty());
}

TEST_F(GatewayDaemonTest, ImagesComeFromTheRobotThatIsWatched) {
  naoremote::Request request;
  request.mutable_subscribe()->set_image_rate(30);
  ask(request);
  const auto num_images = [this] {
    return std::count_if(messages_.begin(), messages_.end(),
                         [](const auto& message) { return message.has_image(); });
  };
  first_.send_image(320, 100);
  ask({});
  EXPECT_EQ(num_images(), 0);
  second_.send_image(320, 100);
  ask({});
  EXPECT_EQ(num_images(), 1);
}

TEST_F(GatewayDaemonTest, ACamerasStatusCountsForItsRobotOnly) {
  naolcm::daemon_status_t status{};
  status.program = "nao-head-camera";
  status.robot = "NAO2";
  bus_.publish(kDaemonStatusChannel, status);
  run();
  EXPECT_FALSE(daemon_.core().robot(0).components().is_available(Component::kCamera));
  EXPECT_TRUE(daemon_.core().robot(1).components().is_available(Component::kCamera));
}

TEST_F(GatewayDaemonTest, AStateThatIsDamagedOrHasNoJointsIsDropped) {
  const auto position = [this] {
    return daemon_.core().robot(1).streams().mirror().robot().joint_position;
  };
  const std::vector<double> before = position();
  ASSERT_EQ(before.size(), kJoints.size());
  naolcm::robot_state_t state{};
  state.utime = 1;
  bus_.publish(RobotChannels("NAO2").robot_state, state);
  const std::vector<uint8_t> damaged = {1, 2, 3};
  bus_.publish_raw(RobotChannels("NAO2").robot_state, damaged);
  bus_.handle();
  EXPECT_EQ(bus_.counters().num_dropped, 2) << "no joints of the state before, either";
  EXPECT_EQ(position(), before);
}

TEST_F(GatewayDaemonTest, TeamsAndNumbersComeFromTheMatch) {
  naolcm::match_state_t match{};
  naolcm::player_t player{};
  player.robot = "NAO2";
  player.team = 1;
  player.number = 3;
  match.players = {player};
  match.num_players = 1;
  match.half = 1;
  bus_.publish("MATCH_STATE", match);
  ask({});
  const naoremote::RobotList* found = nullptr;
  for (const naoremote::ServerMessage& message : messages_) {
    if (message.notice().kind() == naoremote::Notice::ROBOTS_CHANGED) {
      found = &message.notice().robots();
    }
  }
  ASSERT_NE(found, nullptr);
  const naoremote::RobotList& robots = *found;
  ASSERT_EQ(robots.robots_size(), 2);
  EXPECT_FALSE(robots.robots(0).has_team());
  EXPECT_EQ(robots.robots(1).number(), 3u);
}

TEST_F(GatewayDaemonTest, MetricsNameTheRobot) {
  const std::string text = daemon_.metrics_text();
  EXPECT_NE(text.find("component_available{component=\"robot\",robot=\"NAO2\"} 1"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("robot_driver_id{robot=\"NAO2\"} 1"), std::string::npos) << text;
}

}  // namespace
}  // namespace nao::gateway
