#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "kinematics/pose2.h"
#include "robot_model/scene_file.h"
#include "sim/closed_loop/closed_loop.h"
#include "tools/nao-trial/fall_warning.h"

namespace nao::trial {
namespace {

std::shared_ptr<const RobotModel> nao_robot() {
  static const auto model = std::make_shared<const RobotModel>(
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao"));
  return model;
}

class WalkPhysicsTest : public testing::Test {
 protected:
  /** A standing robot, with different noise, latency and physics for each seed. */
  ClosedLoop& begin(uint64_t seed, double late_share = 0, const char* disturbances = "default") {
    ClosedLoopOptions options;
    options.model = nao_robot();
    options.scene = SceneFile::load(std::filesystem::path(NAO_TEST_DATA) / "scenes" / "empty.yaml");
    options.missed_tick_probability = late_share;
    options.disturbances =
        std::make_shared<const sim::DisturbanceSet>(sim::DisturbanceSet::find(disturbances));
    trial_ = std::make_unique<ClosedLoop>(options, seed);
    trial_->run(0.5);
    return *trial_;
  }

  Eigen::Vector2d place() const { return trial_->torso_in_world().translation().head<2>(); }
  double heading() const {
    const Eigen::Matrix3d R = trial_->torso_in_world().linear();
    return std::atan2(R(1, 0), R(0, 0));
  }
  Mode mode() const { return trial_->core().motion_state().mode; }
  std::optional<CommandResult> last_result(int64_t id) const {
    std::optional<CommandResult> found;
    for (const CommandResult& result : trial_->results()) {
      if (result.id == id) found = result;
    }
    return found;
  }
  void expect_standing_in(const char* posture) const {
    EXPECT_EQ(mode(), Mode::kHolding);
    EXPECT_EQ(trial_->core().motion_state().posture, posture);
    EXPECT_LT(trial_->torso_tilt(), 0.2);
  }

  std::unique_ptr<ClosedLoop> trial_;
};

TEST_F(WalkPhysicsTest, WalksAheadAndStandsAgain) {
  ClosedLoop& trial = begin(1);
  const int64_t walk = trial.hold_walk({0.15, 0, 0});
  trial.run(2);
  const Eigen::Vector2d start = place();
  trial.run(4);
  EXPECT_EQ(mode(), Mode::kWalking);
  const Eigen::Vector2d way = place() - start;
  EXPECT_NEAR(way.x() / 4, 0.15, 0.04);
  EXPECT_NEAR(way.y(), 0, 0.15);
  trial.release_walk();
  const auto end = trial.await_end(walk, 6);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
  trial.run(0.5);
  expect_standing_in("StandInit");
}

TEST_F(WalkPhysicsTest, UsedRobotsOnCarpetTurnAtThreeQuartersOfARadianASecond) {
  // The last two have a dead foot sensor, and a gyroscope offset of 3 degrees/s.
  for (const uint64_t seed : {505, 507, 513, 528}) {
    ClosedLoop& trial = begin(seed, 0, "real");
    trial.hold_walk({0, 0, 1.5});
    trial.run(2.5);
    double turn = 0;
    double last = heading();
    trial.on_tick([&] {
      turn += wrapped(heading() - last);
      last = heading();
    });
    trial.run(5);
    EXPECT_EQ(mode(), Mode::kWalking) << seed;
    EXPECT_LT(trial.torso_tilt(), 0.3) << seed;
    EXPECT_GT(turn / 5, 0.75) << seed;
  }
}

TEST_F(WalkPhysicsTest, WalksSidewaysBackAndTurns) {
  ClosedLoop& trial = begin(2);
  trial.hold_walk({0, 0.1, 0});
  trial.run(5);
  EXPECT_GT(place().y(), 0.25);
  trial.hold_walk({-0.1, 0, 0});
  trial.run(1);
  const double start = place().x();
  trial.run(4);
  EXPECT_LT(place().x() - start, -0.25);
  trial.hold_walk({0, 0, -0.8});
  trial.run(1);
  const double looks = heading();
  trial.run(2);
  EXPECT_NEAR(std::remainder(heading() - looks, 2 * M_PI), -1.6, 0.5);
  trial.release_walk();
  trial.run(5);
  expect_standing_in("StandInit");
}

TEST_F(WalkPhysicsTest, TurnsAsFastAsItsLimitsSay) {
  for (const double sign : {1.0, -1.0}) {
    ClosedLoop& trial = begin(5);
    trial.hold_walk({0, 0, sign * nao_robot()->walk_limits().turning});
    trial.run(2);
    double turned = 0;
    double looks = heading();
    trial.on_tick([&] {
      turned += std::remainder(heading() - looks, 2 * M_PI);
      looks = heading();
    });
    trial.run(5);
    EXPECT_NEAR(sign * turned / 5, 2.0, 0.2);
    EXPECT_EQ(mode(), Mode::kWalking);
  }
}

TEST_F(WalkPhysicsTest, TheToeOfAFootInTheAirStaysUp) {
  // Out of a quick turn into full speed, where the swing is the fastest. The foot is lifted by 18
  // mm, the toe 100 mm ahead.
  ClosedLoop& trial = begin(5);
  trial.run(2);  // until the gyroscope's bias is known
  double lowest = 0;
  trial.on_tick([&] {
    const motion::RobotState& state = trial.estimate();
    const auto pitch = [&](int sole) {
      return std::asin(-trial.world().robot(0).link_pose(sole).linear()(2, 0));
    };
    if (state.left_foot_force == 0) lowest = std::max(lowest, pitch(nao_robot()->left_sole()));
    if (state.right_foot_force == 0) lowest = std::max(lowest, pitch(nao_robot()->right_sole()));
  });
  for (int i = 0; i < 5; ++i) {
    trial.hold_walk({0.2, 0, i % 2 == 0 ? 1.2 : -1.2});
    trial.run(2);
    trial.hold_walk({0.3, 0, 0});
    trial.run(1);
  }
  EXPECT_EQ(mode(), Mode::kWalking);
  EXPECT_LT(lowest, 0.04);
}

TEST_F(WalkPhysicsTest, StopsWhenCommandsStopComing) {
  ClosedLoop& trial = begin(3);
  const int64_t walk = trial.hold_walk({0.15, 0, 0});
  trial.run(3);
  trial.release_walk(false);
  const auto end = trial.await_end(walk, 6);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kDone);
  EXPECT_EQ(end->reason.code, "walk-command-timeout");
  trial.run(0.5);
  expect_standing_in("StandInit");
}

TEST_F(WalkPhysicsTest, APostureInterruptsAWalk) {
  ClosedLoop& trial = begin(4);
  const int64_t walk = trial.hold_walk({0.15, 0, 0});
  trial.run(3);
  trial.release_walk(false);
  const int64_t posture = trial.send_posture("Crouch", 0.5);
  const auto end = trial.await_end(posture, 15);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
  EXPECT_EQ(last_result(walk)->status, ResultStatus::kInterrupted);
  trial.run(0.5);
  expect_standing_in("Crouch");
}

TEST_F(WalkPhysicsTest, SaysHowFastItReallyWalksAndWhereItWillStep) {
  ClosedLoop& trial = begin(5);
  trial.hold_walk({5, 0, 0});
  trial.run(4);
  const motion::MotionState& state = trial.core().motion_state();
  EXPECT_DOUBLE_EQ(state.walk_velocity.x(), nao_robot()->walk_limits().forward);
  EXPECT_DOUBLE_EQ(state.walk_velocity.y(), 0);
  ASSERT_GE(state.footsteps.size(), 2u);
  EXPECT_NE(state.footsteps[0].is_left, state.footsteps[1].is_left);
  EXPECT_GT(state.footsteps[1].position_in_odometry.x(),
            state.footsteps[0].position_in_odometry.x());
}

TEST_F(WalkPhysicsTest, MovesToAPlaceByOdometry) {
  ClosedLoop& trial = begin(6);
  const int64_t move = trial.send({"", 0, MoveToCommand{0.6, 0.2, M_PI / 2}});
  const auto end = trial.await_end(move, 40);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
  // Odometry slips a little, mostly in turning.
  EXPECT_NEAR((place() - Eigen::Vector2d(0.6, 0.2)).norm(), 0, 0.1);
  EXPECT_NEAR(heading(), M_PI / 2, 0.25);
}

TEST_F(WalkPhysicsTest, AWalkFromACrouchStandsUpFirst) {
  ClosedLoop& trial = begin(7);
  ASSERT_TRUE(trial.await_end(trial.send_posture("Crouch", 0.5), 15));
  trial.hold_walk({0.15, 0, 0});
  trial.run(12);
  EXPECT_EQ(mode(), Mode::kWalking);
  EXPECT_GT(place().x(), 0.3);
}

TEST_F(WalkPhysicsTest, KeepsWalkingWhenPushed) {
  ClosedLoop& trial = begin(8);
  trial.hold_walk({0.15, 0, 0});
  trial.run(3);
  trial.world().push(0, 0, {0, 0.3, 0});
  trial.run(4);
  EXPECT_EQ(mode(), Mode::kWalking);
  EXPECT_LT(trial.torso_tilt(), 0.3);
}

TEST_F(WalkPhysicsTest, KeepsWalkingWhenItMissesTicks) {
  ClosedLoop& trial = begin(10, 0.02);
  trial.hold_walk({0.12, 0, 0});
  trial.run(8);
  EXPECT_EQ(mode(), Mode::kWalking);
  EXPECT_GT(place().x(), 0.6);
}

TEST_F(WalkPhysicsTest, KeepsStraightAndToItsSpeed) {
  ClosedLoop& trial = begin(11);
  trial.hold_walk({0.25, 0, 0});
  trial.run(2.5);
  const Eigen::Vector2d start = place();
  trial.run(10);
  EXPECT_NEAR((place() - start).x(), 2.5, 0.25);
  EXPECT_NEAR(place().y(), start.y(), 0.2);
}

TEST_F(WalkPhysicsTest, WalksAtFullSpeedWithADeadFootSensor) {
  // The sensor of seed 1 is dead.
  ClosedLoop& trial = begin(1, 0, "foot_sensor_dead_probability");
  ASSERT_EQ(trial.world().sensors(0).foot_force.minCoeff(), 0);
  const double limit = trial.model().walk_limits().forward;
  trial.hold_walk({limit, 0, 0});
  trial.run(2);
  const Eigen::Vector2d start = place();
  trial.run(5);
  EXPECT_GT((place() - start).norm() / 5, 0.9 * limit);
  EXPECT_EQ(mode(), Mode::kWalking);
}

TEST_F(WalkPhysicsTest, StopsFromFullSpeedInShortOrder) {
  // Let go at any moment of a step.
  for (const double more : {0.0, 0.06, 0.12, 0.18}) {
    ClosedLoop& trial = begin(12);
    trial.hold_walk({0.3, 0, 0});
    trial.run(4 + more);
    const Eigen::Vector2d start = place();
    trial.release_walk();
    trial.run(1.2);
    const Eigen::Vector2d stood = place();
    EXPECT_LT((stood - start).norm(), 0.2);
    trial.run(1);
    EXPECT_LT((place() - stood).norm(), 0.005);
    expect_standing_in("StandInit");
  }
}

TEST_F(WalkPhysicsTest, StopsWithinHalfASecondAfterTheJoystickIsReleased) {
  for (const double more : {0.0, 0.06, 0.12, 0.18}) {
    ClosedLoop& trial = begin(14);
    trial.hold_walk({0.15, 0, 0});
    trial.run(4 + more);
    trial.release_walk();
    trial.run(0.5);
    const Eigen::Vector2d stood = place();
    trial.run(1.5);
    EXPECT_LT((place() - stood).norm(), 0.015);
    expect_standing_in("StandInit");
  }
}

TEST_F(WalkPhysicsTest, ContinuesWhenTheJoystickIsTouchedAgainAtOnce) {
  for (const double pause : {0.1, 0.25, 0.4, 0.6}) {
    ClosedLoop& trial = begin(15);
    trial.hold_walk({0.25, 0, 0});
    trial.run(3);
    trial.release_walk();
    trial.run(pause);
    trial.hold_walk({0.25, 0, 0});
    trial.run(3);
    EXPECT_EQ(mode(), Mode::kWalking) << pause;
    EXPECT_LT(trial.torso_tilt(), 0.3) << pause;
  }
}

TEST_F(WalkPhysicsTest, TellsAFallWellBeforeTheImpact) {
  std::vector<double> warnings;
  for (int i = 0; i < 8; ++i) {
    const double direction = i * M_PI / 4;
    ClosedLoop& trial = begin(21 + i);
    trial.hold_walk({0.15, 0, 0});
    trial.run(3);
    trial.world().push(0, 0, {3.2 * std::cos(direction), 3.2 * std::sin(direction), 0});
    FallWarning fall;
    trial.on_tick([&] { fall.look(trial); });
    if (!trial.run_until([&] { return fall.has_touched(); }, 4)) continue;
    // The sample is one fall in each direction.
    EXPECT_GE(*fall.warning(), 0.09) << direction;
    warnings.push_back(*fall.warning());
  }
  ASSERT_GE(warnings.size(), 5);
  std::sort(warnings.begin(), warnings.end());
  EXPECT_GE(warnings[warnings.size() / 2], 0.15);
}

TEST_F(WalkPhysicsTest, AHopDoesNotEndTheWalk) {
  ClosedLoop& trial = begin(13);
  const int64_t walk = trial.hold_walk({0.15, 0, 0});
  trial.run(3);
  // Up at 0.25 m/s: both feet are in the air for 50 ms.
  trial.world().push(0, 0, {0, 0, 0.25 * nao_robot()->total_mass()});
  bool has_hopped = false;
  trial.on_tick([&] {
    const motion::RobotState& state = trial.estimate();
    has_hopped |= !state.left_foot_carries && !state.right_foot_carries;
  });
  trial.run(3);
  EXPECT_TRUE(has_hopped);
  EXPECT_EQ(mode(), Mode::kWalking);
  trial.release_walk();
  const auto end = trial.await_end(walk, 3);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
}

TEST_F(WalkPhysicsTest, StopsInTheAirAndRefusesToWalkThere) {
  ClosedLoop& trial = begin(13);
  const int64_t walk = trial.hold_walk({0.15, 0, 0});
  trial.run(2);
  // Lifts it by the trunk: a spring and a damper to a place above the ground.
  constexpr double kTick = 0.01;
  double last = trial.torso_height();
  const double weight = 9.81 * nao_robot()->total_mass();
  trial.on_tick([&] {
    const double height = trial.torso_height();
    const double force = weight + 400 * (0.45 - height) - 80 * (height - last) / kTick;
    last = height;
    trial.world().push(0, 0, {0, 0, std::clamp(force, 0.0, 3 * weight) * kTick});
  });
  const auto end = trial.await_end(walk, 3);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kFailed);
  EXPECT_EQ(end->reason.code, "robot-lifted");
  trial.release_walk(false);
  trial.run(0.2);
  const int64_t again = trial.hold_walk({0.15, 0, 0});
  trial.run(0.1);
  ASSERT_TRUE(last_result(again));
  EXPECT_EQ(last_result(again)->status, ResultStatus::kRefused);
  EXPECT_EQ(last_result(again)->reason.code, "no-foot-contact");
}

TEST_F(WalkPhysicsTest, ACommandOfNoVelocityStartsNoWalk) {
  ClosedLoop& trial = begin(9);
  const int64_t walk = trial.hold_walk({0, 0, 0});
  trial.run(0.1);
  EXPECT_EQ(mode(), Mode::kHolding);
  ASSERT_TRUE(last_result(walk));
}

}  // namespace
}  // namespace nao::trial
