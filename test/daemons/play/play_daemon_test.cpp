#include "daemons/play/play_daemon.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <naolcm/command_result_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/play_command_t.hpp>
#include <naolcm/play_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <naolcm/walk_command_t.hpp>

#include "common/bus.h"
#include "common/data_path.h"
#include "common/error.h"
#include "messages/match_state.h"

namespace nao::play {
namespace {

class PlayDaemonTest : public testing::Test {
 protected:
  PlayDaemonTest()
      : model_(RobotModel::load(data_path() / "robots" / "nao")),
        bus_("memq://"),
        daemon_(bus_, model_, {}, [this] { return now_; }) {
    collect("NAO_WALK_COMMAND", walks_);
    collect("NAO_COMMAND_RESULT", results_);
    collect("NAO_PLAY_STATE", states_);
  }

  template <class Message>
  void collect(const std::string& channel, std::vector<Message>& messages) {
    bus_.subscribe<Message>(channel, Bus::Queue::kAll,
                            [&messages](const Message& message) { messages.push_back(message); });
  }

  void deliver() {
    while (bus_.handle_for(0)) {
    }
  }

  void publish_robot() {
    naolcm::robot_state_t state{};
    state.utime = utime_;
    state.joint_names = model_.motor_names();
    state.num_joints = model_.num_motors();
    state.joint_position = model_.ready_posture().position;
    state.joint_velocity.assign(model_.num_motors(), 0);
    state.position_torso_in_odometry[2] = 0.32;
    state.orientation_torso_in_odometry[0] = 1;
    bus_.publish("NAO_ROBOT_STATE", state);
    naolcm::motion_state_t motion{};
    motion.utime = utime_;
    motion.mode = naolcm::motion_state_t::MODE_HOLDING;
    bus_.publish("NAO_MOTION_STATE", motion);
  }

  /** The ball lies ahead. */
  void publish_vision() {
    naolcm::vision_state_t vision{};
    vision.utime = utime_;
    vision.camera = "top";
    vision.has_ball = 1;
    vision.ball_utime = utime_;
    vision.ball_position_in_odometry[0] = 2;
    bus_.publish("NAO_VISION_STATE", vision);
  }

  void command(Behavior behavior, int64_t id = 1) {
    naolcm::play_command_t message = to_message(PlayCommand{behavior});
    message.source = "test";
    message.command_id = id;
    bus_.publish("NAO_PLAY_COMMAND", message);
  }

  /** Robot and camera continue for some steps. */
  void run(int steps, bool is_commanded = true) {
    for (int i = 0; i < steps; ++i) {
      utime_ += 50000;
      publish_robot();
      publish_vision();
      if (is_commanded && i % 10 == 0) command(Behavior::kScore);
      deliver();
      daemon_.step(now_ += 0.05);
      deliver();
    }
  }

  // Before the daemon, which reads it.
  double now_ = 1000;
  RobotModel model_;
  Bus bus_;
  PlayDaemon daemon_;
  std::vector<naolcm::walk_command_t> walks_;
  std::vector<naolcm::command_result_t> results_;
  std::vector<naolcm::play_state_t> states_;
  int64_t utime_ = 1000000;
};

TEST_F(PlayDaemonTest, WalksToTheBallAndNamesTheCamera) {
  run(40);
  ASSERT_FALSE(walks_.empty());
  EXPECT_GT(walks_.back().vx, 0.1);
  EXPECT_TRUE(walks_.back().source.starts_with("play."));
  ASSERT_FALSE(states_.empty()) << "published at once when the camera changes";
  EXPECT_EQ(states_.back().camera, "top");
  ASSERT_FALSE(results_.empty());
  EXPECT_EQ(results_[0].command_kind, naolcm::command_result_t::COMMAND_KIND_PLAY);
  EXPECT_EQ(results_[0].status, naolcm::command_result_t::STATUS_ACCEPTED);
  daemon_.publish_state();
  deliver();
  ASSERT_FALSE(states_.empty());
  EXPECT_EQ(states_.back().behavior, naolcm::play_state_t::BEHAVIOR_SCORE);
  EXPECT_EQ(states_.back().phase, naolcm::play_state_t::PHASE_APPROACH);
  EXPECT_EQ(states_.back().command_source, "test");
  EXPECT_NEAR(states_.back().target_in_field[0], 4.5, 0.1);
}

TEST_F(PlayDaemonTest, StopsWalkingTwoSecondsAfterTheLastCommand) {
  run(40);
  walks_.clear();
  run(30, false);
  EXPECT_GT(walks_.back().vx, 0);
  run(20, false);
  EXPECT_EQ(walks_.back().vx, 0);
  EXPECT_EQ(results_.back().reason_code, "play-command-timeout");
}

TEST_F(PlayDaemonTest, EndsWithAStopOfAnybody) {
  run(40);
  naolcm::stop_command_t stop{};
  stop.source = "phone.1";
  stop.command_id = 7;
  bus_.publish("NAO_STOP_COMMAND", stop);
  deliver();
  walks_.clear();
  run(10);
  EXPECT_TRUE(walks_.empty());
  const auto is_end = [](const naolcm::command_result_t& result) {
    return result.status == naolcm::command_result_t::STATUS_INTERRUPTED &&
           result.reason_code == "replaced";
  };
  EXPECT_TRUE(std::any_of(results_.begin(), results_.end(), is_end));
}

TEST_F(PlayDaemonTest, StopsTheWalkWhenTheProgramEnds) {
  run(40);
  walks_.clear();
  daemon_.shut_down(now_);
  deliver();
  ASSERT_EQ(walks_.size(), 3u);
  for (const auto& walk : walks_) EXPECT_EQ(walk.vx, 0);
}

TEST_F(PlayDaemonTest, DropsNumbersThatAreNotFinite) {
  naolcm::vision_state_t vision{};
  vision.has_ball = 1;
  vision.ball_position_in_odometry[0] = std::numeric_limits<double>::quiet_NaN();
  bus_.publish("NAO_VISION_STATE", vision);
  naolcm::robot_state_t state{};
  bus_.publish("NAO_ROBOT_STATE", state);
  deliver();
  EXPECT_EQ(bus_.counters().num_dropped, 2);
}

TEST_F(PlayDaemonTest, RelatesThePoseOnTheFieldToTheOdometryOfThatTime) {
  TorsoHistory torso;
  torso.add(1000000, {{1, 0}, 0});
  torso.add(1100000, {{2, 0}, 0});
  naolcm::vision_state_t message{};
  message.utime = 1010000;
  message.has_field_pose = 1;
  message.torso_in_field[0] = -3;
  const Vision vision = decode_vision(message, torso);
  ASSERT_TRUE(vision.field_in_odometry);
  EXPECT_NEAR(vision.field_in_odometry->position.x(), 4, 1e-9);
  message.utime = 5000000;
  EXPECT_FALSE(decode_vision(message, torso).field_in_odometry);
}

/** A robot that plays by itself in a match. */
class AutonomousTest : public PlayDaemonTest {
 protected:
  AutonomousTest() : autonomous_(bus_, model_, options(), [this] { return now_; }) {}

  static PlayOptions options() {
    PlayOptions options;
    options.is_autonomous = true;
    return options;
  }

  void publish_match() {
    MatchState state;
    state.phase = MatchPhase::kPlaying;
    state.players = {{.robot = "NAO", .team = 0, .number = 1}};
    bus_.publish(kMatchStateChannel, to_message(state, utime_, ++sequence_));
  }

  /** @return Whether it plays after so many s. */
  bool plays_after(double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.05); ++i) {
      utime_ += 50000;
      publish_robot();
      publish_vision();
      if (i % 10 == 0) publish_match();
      deliver();
      autonomous_.step(now_ += 0.05);
    }
    return autonomous_.core().is_active();
  }

  void drive() {
    naolcm::walk_command_t walk{};
    walk.source = "phone.1";
    walk.command_id = 7;
    bus_.publish("NAO_WALK_COMMAND", walk);
    deliver();
  }

  PlayDaemon autonomous_;
  int64_t sequence_ = 0;
};

TEST_F(AutonomousTest, StandsAndSaysSoUntilThePersonWhoDroveItReleasesIt) {
  EXPECT_TRUE(plays_after(2));
  drive();
  EXPECT_FALSE(plays_after(60)) << "a driver that has vanished may stand beside it";
  naolcm::play_state_t state{};
  bus_.subscribe<naolcm::play_state_t>(
      "NAO_PLAY_STATE", Bus::Queue::kLatest,
      [&](const naolcm::play_state_t& message) { state = message; });
  autonomous_.publish_state();
  deliver();
  EXPECT_EQ(state.reason_code, kWaitsForRelease);
  command(Behavior::kAuto);
  EXPECT_TRUE(plays_after(1));
  EXPECT_TRUE(plays_after(5)) << "the one who released it need not repeat the command";
}

TEST_F(AutonomousTest, DropsAMatchWhoseRobotsCannotHaveChannels) {
  MatchState state;
  state.players = {{.robot = "NAO", .team = 0, .number = 1},
                   {.robot = "(", .team = 0, .number = 2}};
  bus_.publish(kMatchStateChannel, to_message(state, 0, 1));
  EXPECT_NO_THROW(deliver());
  EXPECT_GE(bus_.counters().num_dropped, 1);
}

TEST_F(AutonomousTest, WaitsForReleaseAlsoAfterABehaviorAndItsEnd) {
  EXPECT_TRUE(plays_after(2));
  command(Behavior::kNone);
  EXPECT_FALSE(plays_after(60));
}

TEST(RobotViewer, SeesWhereTheCamerasLook) {
  const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  RobotViewer viewer(model);
  Eigen::Isometry3d torso = Eigen::Isometry3d::Identity();
  torso.translation() = Eigen::Vector3d(1, 2, 0.333);
  std::vector<double> position(static_cast<size_t>(model.num_motors()), 0.0);
  RobotView view = viewer.look(torso, position);
  ASSERT_EQ(view.cameras.size(), 2u);
  EXPECT_NEAR(view.feet_in_odometry.position.x(), 1, 0.05);
  EXPECT_NEAR(view.feet_in_odometry.position.y(), 2, 0.01);
  // Camera angles of the NAO: 1.2 and 39.7 degrees below the horizon.
  EXPECT_NEAR(view.cameras[0].depression, 1.2 * M_PI / 180, 0.01);
  EXPECT_NEAR(view.cameras[1].depression, 39.7 * M_PI / 180, 0.01);
  const int yaw = model.find_motor(viewer.head_joints()[0]);
  position[static_cast<size_t>(yaw)] = 0.5;
  view = viewer.look(torso, position);
  EXPECT_NEAR(view.cameras[0].bearing, 0.5, 0.01);
  EXPECT_EQ(view.head_yaw, 0.5);
}

TEST(LoadConstants, ReadsFieldKickAndActions) {
  const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  const PlayConstants constants = load_constants(model, "soccer");
  EXPECT_EQ(constants.field.length, 9);
  EXPECT_NEAR(constants.field.goal_width, 1.5, 1e-9);
  ASSERT_TRUE(constants.kick);
  EXPECT_EQ(constants.actions.dive_left, "dive-left");
  EXPECT_THROW(load_constants(model, "empty"), ConfigError);
}

}  // namespace
}  // namespace nao::play
