#include "daemons/referee/referee_daemon.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <naolcm/command_result_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/match_command_t.hpp>

#include "common/bus.h"
#include "common/error.h"
#include "common/output_file.h"
#include "common/text_file.h"
#include "test/daemons/referee/game_controller_packet.h"
#include "test/support/temporary_folder.h"

namespace nao::referee {
namespace {

/** A world of two robots, whose simulator obeys. */
class RefereeDaemonTest : public testing::Test {
 protected:
  /** @param change  Change of the options, before the daemon is made. */
  explicit RefereeDaemonTest(const std::function<void(RefereeOptions&)>& change = {})
      : bus_("memq://") {
    options_.robots = {{"NAO1", "nao", 0, 1}, {"NAO2", "nao", 1, 1}};
    options_.state_file = folder_.path() / "match.json";
    options_.events_file = folder_.path() / "match.jsonl";
    bus_.subscribe<naolcm::match_state_t>(
        "MATCH_STATE", Bus::Queue::kAll,
        [this](const naolcm::match_state_t& message) { states_.push_back(message); });
    bus_.subscribe<naolcm::command_result_t>(
        "MATCH_COMMAND_RESULT", Bus::Queue::kAll,
        [this](const naolcm::command_result_t& message) { results_.push_back(message); });
    bus_.subscribe<naolcm::world_command_t>(
        "WORLD_COMMAND", Bus::Queue::kAll, [this](const naolcm::world_command_t& message) {
          if (is_simulator_deaf_) return;
          if (truth_.last_command_id == message.command_id) return;
          truth_.last_command_source = message.source;
          truth_.last_command_id = message.command_id;
          done_.push_back(message);
          if (message.command == "place-ball") {
            for (int i = 0; i < 3; ++i) {
              truth_.position_ball_in_world[i] = message.position_in_world[i];
            }
          }
        });
    truth_ = naolcm::world_truth_t{};
    truth_.has_ball = 1;
    truth_.robots = {robot("NAO1", -0.5), robot("NAO2", 1.5)};
    truth_.num_robots = 2;
    if (change) change(options_);
    start();
  }

  static naolcm::robot_truth_t robot(const std::string& name, double x) {
    naolcm::robot_truth_t robot{};
    robot.robot = name;
    robot.model = "nao";
    robot.position_torso_in_world[0] = x;
    robot.orientation_torso_in_world[0] = 1;
    return robot;
  }

  void start() {
    daemon_ = std::make_unique<RefereeDaemon>(bus_, options_, [this] { return now_; });
  }

  void deliver() {
    while (bus_.handle_for(0)) {
    }
  }

  void run(double duration) {
    for (double end = now_ + duration; now_ < end; now_ += 0.05) {
      truth_.utime += 50000;
      bus_.publish("WORLD_TRUTH", truth_);
      deliver();
      daemon_->send_placement();
      deliver();
    }
    daemon_->publish_state();
    deliver();
  }

  void command(MatchOperation operation, int64_t id, int team = 0) {
    naolcm::match_command_t message = to_message(MatchCommand{operation, team, ""});
    message.source = "test";
    message.command_id = id;
    bus_.publish("MATCH_COMMAND", message);
    deliver();
  }

  void play() {
    run(0.1);
    command(MatchOperation::kStart, 1);
    run(14);
    ASSERT_EQ(states_.back().phase, naolcm::match_state_t::PHASE_PLAYING);
  }

  const TemporaryFolder folder_;
  RefereeOptions options_;
  double now_ = 50;
  Bus bus_;
  naolcm::world_truth_t truth_;
  bool is_simulator_deaf_ = false;
  std::vector<naolcm::match_state_t> states_;
  std::vector<naolcm::command_result_t> results_;
  std::vector<naolcm::world_command_t> done_;
  std::unique_ptr<RefereeDaemon> daemon_;
};

TEST_F(RefereeDaemonTest, StartsOnCommandAndPutsTheBallOntoTheMark) {
  truth_.position_ball_in_world[0] = 2;
  play();
  EXPECT_EQ(results_.back().status, naolcm::command_result_t::STATUS_DONE);
  ASSERT_FALSE(done_.empty());
  EXPECT_EQ(done_.back().command, "place-ball");
  EXPECT_EQ(truth_.position_ball_in_world[0], 0);
}

TEST_F(RefereeDaemonTest, AGoalCountsOnceAndIsWritten) {
  play();
  truth_.position_ball_in_world[0] = 4.7;
  run(0.5);
  EXPECT_EQ(states_.back().score[0], 1);
  EXPECT_EQ(states_.back().event, naolcm::match_state_t::EVENT_GOAL);
  run(1);
  EXPECT_EQ(states_.back().score[0], 1);
  const std::string events = read_file(options_.events_file);
  EXPECT_THAT(events, testing::HasSubstr("\"event\":\"goal\""));
  EXPECT_THAT(events, testing::HasSubstr("\"event\":\"kick-off\""));
}

TEST_F(RefereeDaemonTest, ARestartedRefereeGoesOn) {
  play();
  command(MatchOperation::kGoal, 2, 1);
  truth_.robots = {robot("NAO1", -0.5), robot("NAO2", 1.5)};
  run(16);
  const auto before = states_.back();
  Bus other_bus("memq://");
  const RefereeDaemon next(other_bus, options_, [this] { return now_; });
  EXPECT_EQ(next.referee().state().id, before.match_id);
  EXPECT_EQ(next.referee().state().score[1], 1);
  EXPECT_EQ(static_cast<int>(next.referee().state().phase), before.phase);
  EXPECT_NEAR(next.referee().state().time_left, before.time_left, 1.5);
}

/** With --start another match would begin, and the result would be lost. */
TEST_F(RefereeDaemonTest, ARestartedRefereeKeepsTheResultOfAFinishedMatch) {
  play();
  command(MatchOperation::kGoal, 2, 1);
  command(MatchOperation::kFinish, 3);
  run(0.2);
  Bus other_bus("memq://");
  const RefereeDaemon next(other_bus, options_, [this] { return now_; });
  EXPECT_EQ(next.referee().state().phase, MatchPhase::kFinished);
  EXPECT_EQ(next.referee().state().score[1], 1);
}

TEST_F(RefereeDaemonTest, RepeatsAPlacementUntilTheSimulatorAnswers) {
  run(0.1);
  command(MatchOperation::kStart, 1);
  truth_.position_ball_in_world[0] = 2;
  is_simulator_deaf_ = true;
  run(14);
  EXPECT_EQ(truth_.position_ball_in_world[0], 2);
  is_simulator_deaf_ = false;
  run(0.3);
  EXPECT_EQ(truth_.position_ball_in_world[0], 0);
}

TEST_F(RefereeDaemonTest, ARepeatedCommandIsAnsweredAgainAndExecutedOnce) {
  play();
  command(MatchOperation::kGoal, 7, 0);
  command(MatchOperation::kGoal, 7, 0);
  EXPECT_EQ(states_.back().score[0], 1);
  EXPECT_EQ(results_.size(), 3u);
  command(static_cast<MatchOperation>(99), 8);
  EXPECT_EQ(results_.back().status, naolcm::command_result_t::STATUS_REFUSED);
  EXPECT_EQ(results_.back().reason_code, "match-operation-unknown");
}

TEST_F(RefereeDaemonTest, SeesTouchesOfTheBall) {
  naolcm::contact_t contact{};
  contact.body_a = "NAO2/LFoot";
  contact.body_b = "ball";
  truth_.contacts = {contact};
  truth_.num_contacts = 1;
  const RefereeInput input = to_input(truth_, daemon_->referee().state().players);
  ASSERT_EQ(input.robots.size(), 2u);
  EXPECT_FALSE(input.robots[0].touches_ball);
  EXPECT_TRUE(input.robots[1].touches_ball);
}

TEST_F(RefereeDaemonTest, RobotsNeedTeamsAndAFileMustBeAMatch) {
  RefereeOptions options = options_;
  options.robots[0].team.reset();
  EXPECT_THROW(RefereeDaemon(bus_, options), ConfigError);
  replace_file(options_.state_file, "{");
  EXPECT_THROW(RefereeDaemon(bus_, options_), Error);
}

/** A GameController on this host: a UDP socket. */
class FakeGameController {
 public:
  FakeGameController() : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    timeval timeout{1, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
  }
  ~FakeGameController() { close(socket_); }
  FakeGameController(const FakeGameController&) = delete;
  FakeGameController& operator=(const FakeGameController&) = delete;

  uint16_t port() const { return port_; }
  void send(const std::vector<uint8_t>& bytes, uint16_t port) const {
    const sockaddr_in address = loopback(port);
    EXPECT_EQ(sendto(socket_, bytes.data(), bytes.size(), 0,
                     reinterpret_cast<const sockaddr*>(&address), sizeof address),
              static_cast<ssize_t>(bytes.size()));
  }
  std::vector<uint8_t> receive() const {
    std::vector<uint8_t> bytes(100);
    const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
    bytes.resize(static_cast<size_t>(std::max<ssize_t>(0, count)));
    return bytes;
  }

 private:
  static sockaddr_in loopback(uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
  }
  int socket_;
  uint16_t port_ = 0;
};

/** Exists before the daemon. */
TEST_F(RefereeDaemonTest, NamesASecondReferee) {
  std::string detail;
  bus_.subscribe<naolcm::daemon_status_t>("DAEMON_STATUS", Bus::Queue::kLatest,
                                          [&](const naolcm::daemon_status_t& status) {
                                            if (status.process_id == getpid())
                                              detail = status.detail;
                                          });
  naolcm::daemon_status_t other{};
  other.program = "nao-referee";
  other.host = "pc";
  other.process_id = 12;
  bus_.publish("DAEMON_STATUS", other);
  deliver();
  daemon_->publish_status(now_);
  deliver();
  EXPECT_EQ(detail, "a second nao-referee is on this bus: host pc, process 12");
}

struct HasGameController {
  FakeGameController controller;
};

class GameControllerDaemonTest : private HasGameController, public RefereeDaemonTest {
 protected:
  GameControllerDaemonTest()
      : RefereeDaemonTest([this](RefereeOptions& options) {
          options.game_controller_port = 0;
          options.return_port = controller.port();
        }) {}

  const FakeGameController& game_controller() const { return controller; }
};

TEST_F(GameControllerDaemonTest, IsReadyWithoutItSoThatTheStackStarts) {
  std::string state, detail;
  bus_.subscribe<naolcm::daemon_status_t>("DAEMON_STATUS", Bus::Queue::kLatest,
                                          [&](const naolcm::daemon_status_t& status) {
                                            state = status.state;
                                            detail = status.detail;
                                          });
  run(0.1);
  daemon_->publish_status(now_);
  deliver();
  EXPECT_EQ(state, "ready");
  EXPECT_EQ(detail, "waits for the GameController at UDP port " +
                        std::to_string(daemon_->game_controller_port()));
}

TEST_F(GameControllerDaemonTest, ObeysTheFirstOfTwoUntilItIsSilent) {
  const FakeGameController other;
  GameControllerPacket packet;
  packet.version = 20;
  packet.state = 3;
  const auto goals = [&](const FakeGameController& from, uint8_t score) {
    packet.scores = {score, 0};
    from.send(packet.bytes(), daemon_->game_controller_port());
    daemon_->receive_game_controller();
    run(0.1);
    return states_.back().score[0];
  };
  EXPECT_EQ(goals(game_controller(), 1), 1);
  EXPECT_EQ(goals(other, 7), 1);
  EXPECT_EQ(goals(game_controller(), 2), 2);
  std::string detail;
  bus_.subscribe<naolcm::daemon_status_t>(
      "DAEMON_STATUS", Bus::Queue::kLatest,
      [&](const naolcm::daemon_status_t& status) { detail = status.detail; });
  EXPECT_EQ(goals(other, 8), 2);
  daemon_->publish_status(now_);
  deliver();
  EXPECT_EQ(detail, "playing, 2:0; ignores a second GameController at 127.0.0.1:" +
                        std::to_string(other.port()));
  now_ += 4;
  EXPECT_EQ(goals(other, 3), 3);
}

TEST_F(GameControllerDaemonTest, FollowsItAndAnswersForEveryRobot) {
  const FakeGameController& controller = game_controller();
  GameControllerPacket packet;
  packet.state = 3;
  packet.scores = {0, 1};
  // Other messages change nothing, and are not answered.
  controller.send({'R', 'G', 'm', 'e', 99}, daemon_->game_controller_port());
  controller.send(packet.bytes(), daemon_->game_controller_port());
  daemon_->receive_game_controller();
  truth_.robots[1].orientation_torso_in_world[0] = std::sqrt(0.5);
  truth_.robots[1].orientation_torso_in_world[1] = std::sqrt(0.5);
  naolcm::vision_state_t vision{};
  vision.utime = truth_.utime;
  vision.has_field_pose = 1;
  vision.torso_in_field[0] = -1.25;
  bus_.publish("NAO1_VISION_STATE", vision);
  run(0.3);
  EXPECT_EQ(daemon_->referee().state().phase, MatchPhase::kPlaying);
  EXPECT_EQ(states_.back().score[1], 1);
  daemon_->answer_game_controller();
  const std::vector<uint8_t> first = controller.receive();
  ASSERT_EQ(first.size(), kGameControllerReturnSize);
  EXPECT_EQ(first[5], 1);
  EXPECT_EQ(first[6], 5);
  EXPECT_EQ(first[7], 0);
  float x = 0;
  std::memcpy(&x, &first[8], sizeof x);
  EXPECT_EQ(x, -1250);
  const std::vector<uint8_t> second = controller.receive();
  ASSERT_EQ(second.size(), kGameControllerReturnSize);
  EXPECT_EQ(second[6], 12);
  EXPECT_EQ(second[7], 1) << "NAO2 lies";

  naolcm::match_command_t command{};
  command.source = "test";
  command.command_id = 1;
  bus_.publish("MATCH_COMMAND", command);
  deliver();
  EXPECT_EQ(results_.back().reason_code, "match-by-game-controller");
}

/** A referee whose disk is full. */
class RefereeOnAFullDisk : public RefereeDaemonTest {
 protected:
  RefereeOnAFullDisk()
      : RefereeDaemonTest([](RefereeOptions& options) { options.events_file = "/dev/full"; }) {}
};

TEST_F(RefereeOnAFullDisk, SaysSoInItsStatusAndPlaysOn) {
  std::string detail;
  bus_.subscribe<naolcm::daemon_status_t>(
      "DAEMON_STATUS", Bus::Queue::kAll,
      [&](const naolcm::daemon_status_t& status) { detail = status.detail; });
  play();
  daemon_->publish_status(now_);
  deliver();
  EXPECT_EQ(detail, "playing, 0:0; cannot write /dev/full: No space left on device");
}

}  // namespace
}  // namespace nao::referee
