// A gateway of several robots: leases, changes of robot, the list of robots, the operator.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

using naoremote::Notice;
using naoremote::Operate;

class GatewayRobots : public GatewayFixture {
 protected:
  GatewayRobots() { restart_with(2); }

  void restart_with(int num_robots) {
    commands_.assign(static_cast<size_t>(num_robots), {});
    std::vector<RobotSetup> robots;
    for (size_t i = 0; i < commands_.size(); ++i) {
      naoremote::RobotDescription description = make_test_robot();
      description.set_name("NAO" + std::to_string(i + 1));
      robots.push_back(
          {description, {[this, i](const Command& command) { commands_[i].push_back(command); }}});
    }
    // Another model.
    robots.back().description.set_model("other");
    robots.back().description.clear_cameras();
    robots.back().description.add_cameras("head");
    robots.back().description.clear_postures();
    robots.back().description.add_postures("ready");
    start(std::move(robots), GatewayLimits{});
  }

  /** @param robot  Empty: the client names none. */
  naoremote::Response connect_to(Client& client, const std::string& robot) {
    naoremote::Request request = make_connect("");
    request.mutable_connect()->set_client_name("client " + std::to_string(client.id));
    request.mutable_connect()->set_robot(robot);
    return ask(client, request);
  }
  Client connect_to(const std::string& robot) {
    Client client = open();
    EXPECT_EQ(connect_to(client, robot).error(), naoremote::OK);
    return client;
  }
  naoremote::Response take(Client& client, const std::string& robot) {
    naoremote::Request request;
    request.mutable_take_control()->set_robot(robot);
    return ask(client, request);
  }
  naoremote::Response watch(Client& client, const std::string& robot) {
    naoremote::Request request;
    request.mutable_watch_robot()->set_robot(robot);
    return ask(client, request);
  }
  naoremote::Response operate_on(Client& console, Operate::Operation operation, uint32_t client,
                                 const std::string& robot) {
    naoremote::Request request;
    request.mutable_operate()->set_operation(operation);
    request.mutable_operate()->set_client_id(client);
    request.mutable_operate()->set_robot(robot);
    return ask(console, request);
  }

  uint32_t driver(size_t robot) { return core_->robot(robot).driving().driver(); }
  naoremote::RobotList last_list(Client& client) {
    const auto found = notices(client, Notice::ROBOTS_CHANGED);
    return found.empty() ? naoremote::RobotList() : found.back().robots();
  }
  /** Last velocity that a robot was sent. */
  WalkCommand last_walk_of(size_t robot) {
    const std::vector<Command>& commands = commands_[robot];
    for (auto it = commands.rbegin(); it != commands.rend(); ++it) {
      if (const auto* walk = std::get_if<WalkCommand>(&it->request)) return *walk;
    }
    ADD_FAILURE() << "no walk was sent";
    return {};
  }

  /** Commands that each robot was sent. */
  std::vector<std::vector<Command>> commands_;
};

// ---- Connecting ---------------------------------------------------------------------------------

TEST_F(GatewayRobots, AreListedInConnected) {
  core_->set_players({{"NAO2", 1, 4}});
  Client client = open();
  const auto connected = connect_to(client, "").connected();
  EXPECT_EQ(connected.robot().name(), "NAO1");
  ASSERT_EQ(connected.robots().robots_size(), 2);
  EXPECT_EQ(connected.robots().robots(0).name(), "NAO1");
  EXPECT_FALSE(connected.robots().robots(0).has_team());
  EXPECT_TRUE(connected.robots().robots(0).is_available());
  EXPECT_EQ(connected.robots().robots(1).model(), "other");
  EXPECT_EQ(connected.robots().robots(1).team(), 1u);
  EXPECT_EQ(connected.robots().robots(1).number(), 4u);
}

TEST_F(GatewayRobots, AreNeitherListedNorNamedWhereThereIsOnlyOne) {
  restart_with(1);
  Client ana = open();
  const auto connected = connect_to(ana, "").connected();
  EXPECT_FALSE(connected.has_robots());
  take_control(ana);
  pass(0.1);
  EXPECT_TRUE(notices(ana, Notice::ROBOTS_CHANGED).empty());
  Client console = open();
  EXPECT_EQ(operate(console, Operate::LIST).clients().clients(0).robot(), "");
  EXPECT_EQ(audit_.back().event, "drives");
  EXPECT_EQ(audit_.back().detail, "");
}

TEST_F(GatewayRobots, AreChosenByNameOrFreeFirst) {
  Client ana = connect_to("NAO1");
  EXPECT_EQ(take_control(ana).error(), naoremote::OK);
  Client ben = open();
  EXPECT_EQ(connect_to(ben, "").connected().robot().name(), "NAO2") << "nobody drives it";
  EXPECT_EQ(take_control(ben).error(), naoremote::OK);
  Client cid = open();
  EXPECT_EQ(connect_to(cid, "").connected().robot().name(), "NAO1") << "none is free";
  Client dan = open();
  EXPECT_EQ(connect_to(dan, "NAO2").connected().control().driver_id(), ben.id);
}

TEST_F(GatewayRobots, ThatAreUnknownAreRefusedAndTheClientMayChooseAnother) {
  Client client = open();
  const auto response = connect_to(client, "NAO9");
  EXPECT_EQ(response.error(), naoremote::INVALID_ARGUMENT);
  EXPECT_EQ(response.reason_code(), "robot-unknown");
  EXPECT_EQ(response.reason_arguments(1), "NAO1, NAO2");
  EXPECT_FALSE(core_->is_closing(client.id));
  EXPECT_EQ(ping(client).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(connect_to(client, "NAO2").error(), naoremote::OK);
  EXPECT_EQ(watch(client, "NAO9").reason_code(), "robot-unknown");
  EXPECT_EQ(watch(client, "").reason_code(), "robot-unknown");
  EXPECT_EQ(take(client, "NAO9").reason_code(), "robot-unknown");
  EXPECT_EQ(client.received.back().response().error(), naoremote::INVALID_ARGUMENT);
}

// ---- Control ------------------------------------------------------------------------------------

TEST_F(GatewayRobots, EachHaveADriverOfTheirOwn) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  EXPECT_EQ(take_control(ana).error(), naoremote::OK);
  EXPECT_EQ(take_control(ben).error(), naoremote::OK);
  EXPECT_EQ(driver(0), ana.id);
  EXPECT_EQ(driver(1), ben.id);
  EXPECT_EQ(notices(ana, Notice::CONTROL_CHANGED).size(), 1u)
      << "only of the robot that it watches";
  pass(0.1);
  EXPECT_EQ(last_list(ana).robots(1).driver_name(), "client 2");
}

TEST_F(GatewayRobots, AreCommandedByTheirOwnDriverOnly) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  take_control(ana);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
  EXPECT_EQ(walk(ben, 0.1).error(), naoremote::NO_CONTROL)
      << "driving another robot does not count";
  EXPECT_EQ(go_to(ana, "ready").error(), naoremote::INVALID_ARGUMENT)
      << "the other robot's posture";
  pass(0.3);
  EXPECT_FALSE(commands_[0].empty());
  EXPECT_TRUE(commands_[1].empty());
  EXPECT_EQ(stop(ben).error(), naoremote::OK) << "stops its own robot";
  EXPECT_TRUE(std::holds_alternative<WalkCommand>(commands_[0].back().request));
  EXPECT_TRUE(std::holds_alternative<StopCommand>(commands_[1].back().request));
}

TEST_F(GatewayRobots, ReportTheResultsOfTheirOwnCommands) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  take_control(ana);
  take_control(ben);
  go_to(ana, "Stand");
  go_to(ben, "ready");
  const Command& command = commands_[1].back();
  CommandResult result;
  result.source = command.source;
  result.id = command.id;
  result.kind = kind_of(command);
  result.status = ResultStatus::kDone;
  core_->robot(1).handle_result(result, now_);
  EXPECT_EQ(notices(ben, Notice::COMMAND_RESULT).size(), 1u);
  EXPECT_TRUE(notices(ana, Notice::COMMAND_RESULT).empty());
}

// ---- Changes ------------------------------------------------------------------------------------

TEST_F(GatewayRobots, AreReleasedAndStoppedByAChangeToAnother) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO1");
  take_control(ana);
  walk(ana, 0.1);
  ana.received.clear();
  const auto response = watch(ana, "NAO2");
  EXPECT_EQ(response.error(), naoremote::OK);
  EXPECT_FALSE(response.control().is_mine());
  EXPECT_EQ(driver(0), 0u);
  EXPECT_EQ(last_walk_of(0).vx, 0);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::NO_CONTROL);
  EXPECT_EQ(notices(ben, Notice::CONTROL_CHANGED).back().reason_code(), "driver-left");
  // The answer comes first, then the description.
  ASSERT_GE(ana.received.size(), 2u);
  EXPECT_TRUE(ana.received[0].has_response());
  EXPECT_EQ(ana.received[1].notice().kind(), Notice::ROBOT_CHANGED);
  EXPECT_EQ(ana.received[1].notice().robot().name(), "NAO2");
  EXPECT_EQ(ana.received[1].notice().robot().cameras(0), "head");
  EXPECT_TRUE(notices(ana, Notice::CONTROL_CHANGED).empty());
}

TEST_F(GatewayRobots, OfAMoveThatADriverLeavesBehindAreStopped) {
  Client ana = connect_to("NAO1");
  take_control(ana);
  naoremote::Request request;
  request.mutable_move_to()->set_x(1);
  EXPECT_EQ(ask(ana, request).error(), naoremote::OK);
  watch(ana, "NAO2");
  EXPECT_TRUE(std::holds_alternative<StopCommand>(commands_[0].back().request));
}

TEST_F(GatewayRobots, MayBeTakenDirectly) {
  Client ana = connect_to("NAO1");
  take_control(ana);
  const auto response = take(ana, "NAO2");
  EXPECT_TRUE(response.control().is_mine());
  EXPECT_EQ(driver(0), 0u);
  EXPECT_EQ(driver(1), ana.id);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
  EXPECT_EQ(last_walk_of(1).vx, 0.1);
  EXPECT_EQ(notices(ana, Notice::ROBOT_CHANGED).size(), 1u);
}

TEST_F(GatewayRobots, ThatAnotherClientDrivesAreNotChangedTo) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  take_control(ana);
  take_control(ben);
  const auto response = take(ana, "NAO2");
  EXPECT_EQ(response.error(), naoremote::CONTROL_TAKEN);
  EXPECT_EQ(response.control().driver_id(), ben.id);
  EXPECT_EQ(driver(0), ana.id);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
  EXPECT_TRUE(notices(ana, Notice::ROBOT_CHANGED).empty());
}

TEST_F(GatewayRobots, SendStatesAndImagesToTheirOwnClients) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  subscribe(ana, 10, 10);
  subscribe(ben, 10, 10);
  receive_image(1);
  EXPECT_EQ(images(ana).size(), 1u);
  EXPECT_TRUE(images(ben).empty());
  EXPECT_EQ(core_->robot(0).streams().camera_requests(now_).at(0).image.camera, "top");
  watch(ana, "NAO2");
  EXPECT_TRUE(core_->robot(0).streams().camera_requests(now_).empty());
  EXPECT_EQ(core_->robot(1).streams().camera_requests(now_).at(0).image.camera, "head")
      << "the subscription goes on, with this robot's camera";
  absent_robot_ = 0;
  ana.received.clear();
  for (int i = 0; i < 10; ++i) {
    pass(0.1);
    collect(ana);
  }
  EXPECT_GE(num_states(ana), 9) << "of the robot that is there";
}

TEST_F(GatewayRobots, StopWhenTheirDriverDisconnectsAndAreOfferedToAll) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  take_control(ana);
  walk(ana, 0.1);
  pass(0.1);
  EXPECT_EQ(last_list(ben).robots(0).driver_id(), ana.id);
  core_->closed(ana.id, "test", now_);
  EXPECT_EQ(last_walk_of(0).vx, 0);
  pass(0.1);
  EXPECT_EQ(last_list(ben).robots(0).driver_id(), 0u);
  EXPECT_EQ(take(ben, "NAO1").error(), naoremote::OK);
}

TEST_F(GatewayRobots, ThatAreAbsentAreListedSoAndRefuseCommands) {
  absent_robot_ = 1;
  pass(2);
  Client ana = open();
  const auto connected = connect_to(ana, "NAO2").connected();
  EXPECT_FALSE(connected.robots().robots(1).is_available());
  EXPECT_EQ(notices(ana, Notice::COMPONENT_CHANGED).size(), 3u);
  EXPECT_EQ(take_control(ana).error(), naoremote::OK);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::ROBOT_UNAVAILABLE);
  Client ben = connect_to("NAO1");
  EXPECT_TRUE(notices(ben, Notice::COMPONENT_CHANGED).empty());
  absent_robot_ = SIZE_MAX;
  pass(0.1);
  EXPECT_TRUE(last_list(ben).robots(1).is_available());
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
}

// ---- The operator -------------------------------------------------------------------------------

TEST_F(GatewayRobots, AreTakenByTheOperatorOneByOneOrAll) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  take_control(ana);
  take_control(ben);
  Client console = open();
  EXPECT_EQ(operate_on(console, Operate::TAKE, 0, "NAO2").error(), naoremote::OK);
  EXPECT_EQ(driver(0), ana.id);
  EXPECT_EQ(driver(1), kOperatorId);
  EXPECT_EQ(operate_on(console, Operate::TAKE, 0, "").error(), naoremote::OK);
  EXPECT_EQ(driver(0), kOperatorId);
  EXPECT_EQ(operate_on(console, Operate::RELEASE, 0, "").error(), naoremote::OK);
  EXPECT_EQ(driver(0) + driver(1), 0u);
  EXPECT_EQ(operate_on(console, Operate::TAKE, 0, "NAO9").reason_code(), "robot-unknown");
}

TEST_F(GatewayRobots, AreAssignedByTheOperator) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  take_control(ana);
  take_control(ben);
  walk(ana, 0.1);
  walk(ben, 0.1);
  Client console = open();
  EXPECT_EQ(operate_on(console, Operate::ASSIGN, ana.id, "NAO2").error(), naoremote::OK);
  EXPECT_EQ(driver(0), 0u);
  EXPECT_EQ(driver(1), ana.id);
  EXPECT_EQ(last_walk_of(0).vx, 0);
  EXPECT_EQ(last_walk_of(1).vx, 0);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::STOPPED) << "a joystick held for the other robot";
  pass(0.6);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
  EXPECT_EQ(notices(ana, Notice::ROBOT_CHANGED).size(), 1u);
  EXPECT_TRUE(notices(ana, Notice::CONTROL_CHANGED).back().control().is_mine());
  EXPECT_EQ(operate(console, Operate::LIST).clients().clients(0).robot(), "NAO2");
  EXPECT_EQ(operate_on(console, Operate::ASSIGN, 99, "NAO2").reason_code(), "client-unknown");
  EXPECT_EQ(operate_on(console, Operate::ASSIGN, ana.id, "NAO9").reason_code(), "robot-unknown");
}

TEST_F(GatewayRobots, AreOnlyWatchedByMutedClients) {
  Client ana = connect_to("NAO1");
  take_control(ana);
  walk(ana, 0.1);
  Client console = open();
  EXPECT_EQ(operate(console, Operate::MUTE, ana.id).error(), naoremote::OK);
  EXPECT_EQ(driver(0), 0u);
  EXPECT_EQ(last_walk_of(0).vx, 0);
  const auto muted = notices(ana, Notice::CONTROL_CHANGED).back();
  EXPECT_TRUE(muted.control().is_muted());
  EXPECT_EQ(muted.reason_code(), "muted-by-operator");
  EXPECT_EQ(take_control(ana).error(), naoremote::NOT_ALLOWED);
  EXPECT_EQ(take(ana, "NAO2").error(), naoremote::NOT_ALLOWED);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::NOT_ALLOWED);
  EXPECT_EQ(stop(ana).error(), naoremote::OK) << "every client may stop the robot";
  EXPECT_TRUE(watch(ana, "NAO2").control().is_muted()) << "with every robot";
  EXPECT_TRUE(operate(console, Operate::LIST).clients().clients(0).is_muted());
  EXPECT_EQ(operate_on(console, Operate::ASSIGN, ana.id, "NAO1").reason_code(), "client-muted");
  EXPECT_EQ(operate(console, Operate::UNMUTE, ana.id).error(), naoremote::OK);
  EXPECT_EQ(take_control(ana).error(), naoremote::OK);
}

TEST_F(GatewayRobots, AreDrivenWithAnInvitationForDriving) {
  Client ana = invite(false);
  EXPECT_FALSE(ask(ana, make_connect("")).connected().control().is_muted()) << "needs no token";
  EXPECT_EQ(take_control(ana).error(), naoremote::OK);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
  EXPECT_EQ(operate(ana, Operate::LIST).error(), naoremote::NOT_ALLOWED);
}

TEST_F(GatewayRobots, AreOnlyWatchedWithAnInvitationForWatching) {
  Client ben = invite(true);
  EXPECT_TRUE(ask(ben, make_connect("")).connected().control().is_muted());
  EXPECT_EQ(take_control(ben).error(), naoremote::NOT_ALLOWED);
  EXPECT_EQ(walk(ben, 0.1).error(), naoremote::NOT_ALLOWED);
  Client console = open();
  EXPECT_EQ(operate(console, Operate::UNMUTE, ben.id).error(), naoremote::OK);
  EXPECT_EQ(take_control(ben).error(), naoremote::NOT_ALLOWED) << "it stays one for watching";
}

TEST_F(GatewayRobots, AreOperatedWithAnInvitationForOperating) {
  Client ben = connect_to("NAO1");
  take_control(ben);
  walk(ben, 0.1);
  Client ana = invite(false, true);
  EXPECT_EQ(operate(ana, Operate::LIST).error(), naoremote::NOT_CONNECTED);
  ask(ana, make_connect(""));
  EXPECT_EQ(take(ana, "NAO1").error(), naoremote::OK) << "without asking the driver";
  EXPECT_EQ(driver(0), ana.id);
  EXPECT_EQ(last_walk_of(0).vx, 0);
  EXPECT_EQ(take_control(ben).error(), naoremote::CONTROL_TAKEN);
  EXPECT_EQ(operate(ana, Operate::MUTE, ben.id).error(), naoremote::OK);
  Client console = open();
  operate(console, Operate::TAKE);
  EXPECT_EQ(take_control(ana).error(), naoremote::CONTROL_TAKEN) << "the console overrides all";
}

class GatewayOverview : public GatewayRobots {
 protected:
  GatewayOverview() {
    std::vector<RobotSetup> robots;
    for (const char* name : {"NAO1", "NAO2", "NAO3"}) {
      naoremote::RobotDescription description = make_test_robot();
      description.set_name(name);
      description.add_cameras(kOverviewCamera);
      robots.push_back({description, {}});
    }
    start(std::move(robots), GatewayLimits{});
  }

  void request(Client& client, const std::string& camera, double rate, uint32_t quality = 0) {
    naoremote::Request request;
    request.mutable_subscribe()->set_image_rate(rate);
    request.mutable_subscribe()->mutable_image()->set_camera(camera);
    request.mutable_subscribe()->mutable_image()->set_quality(quality);
    EXPECT_EQ(ask(client, request).error(), naoremote::OK);
  }
  /** "overview 320 5.0 80" for each image request to a robot's camera program. */
  std::vector<std::string> requests_to(size_t robot) {
    std::vector<std::string> texts;
    for (const CameraRequest& request : core_->camera_requests(robot, now_)) {
      texts.push_back(request.image.camera + " " + std::to_string(request.image.width) + " " +
                      std::to_string(static_cast<int>(request.rate)) + " " +
                      std::to_string(request.image.quality));
    }
    return texts;
  }
};

TEST_F(GatewayOverview, IsTakenOnceForTheClientsOfAllRobots) {
  Client ana = connect_to("NAO1");
  Client ben = connect_to("NAO2");
  Client eva = connect_to("NAO3");
  request(ana, "top", 10);
  request(ben, kOverviewCamera, 5, 70);
  request(eva, kOverviewCamera, 8, 50);
  using Texts = std::vector<std::string>;
  EXPECT_EQ(requests_to(0), (Texts{"top 320 10 0", "overview 320 8 70"}));
  EXPECT_EQ(requests_to(1), Texts{});
  EXPECT_EQ(requests_to(2), Texts{});

  pass(1);
  CachedImage image;
  image.camera = kOverviewCamera;
  image.utime = 7;
  image.width = 320;
  image.jpeg = "field";
  core_->add_image(0, image, now_);
  EXPECT_TRUE(images(ana).empty());
  ASSERT_EQ(images(ben).size(), 1u);
  EXPECT_EQ(images(ben)[0].jpeg(), "field");
  EXPECT_EQ(images(eva).size(), 1u);
  image.camera = "top";
  core_->add_image(1, image, now_);
  EXPECT_EQ(images(ben).size(), 1u) << "another camera";
}

TEST_F(GatewayOverview, DoesNotStandForTheRobotsOwnCamera) {
  Client ben = connect_to("NAO2");
  request(ben, kOverviewCamera, 5);
  // Its own camera program sends nothing, and need not.
  for (int i = 0; i < 30; ++i) pass(0.1);
  EXPECT_TRUE(core_->robot(1).components().is_available(Component::kCamera));
}

}  // namespace
}  // namespace nao::gateway
