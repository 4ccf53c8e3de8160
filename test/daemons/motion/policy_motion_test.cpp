// Networks whose outputs are known move a simulated T1: everything around a policy.
#include "daemons/motion/generators/policy_motion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/error.h"
#include "sim/closed_loop/closed_loop.h"
#include "test/daemons/motion/perfect_robot.h"
#include "test/daemons/motion/policy_robot.h"

namespace nao::motion {
namespace {

constexpr const char* kWalk =
    "kind: walk\ncommand: {vx: [-0.2, 0.4], vy: [-0.1, 0.1], wz: [-0.3, 0.3]}\n";
constexpr const char* kKnees =
    "  - {name: Left_Knee_Pitch, stiffness: 300, damping: 5}\n"
    "  - {name: Right_Knee_Pitch, stiffness: 300, damping: 5}\n";
constexpr const char* kArm = "  - {name: Left_Shoulder_Pitch}\n";

class PolicyMotionTest : public testing::Test {
 protected:
  /** A robot that stands, with these policies. */
  void begin(const std::string& walk_policy = "") {
    ClosedLoopOptions options;
    options.model = robot_.load();
    options.scene = SceneFile::load(std::filesystem::path(NAO_TEST_DATA) / "scenes" / "empty.yaml");
    options.is_ideal = true;
    options.motion.policy = walk_policy;
    loop_ = std::make_unique<ClosedLoop>(options, 1);
    loop_->on_tick([this] { watch_targets(); });
    loop_->run(1);
  }
  /** The greatest speed of a target, rad/s. */
  void watch_targets() {
    const std::vector<double>& targets = loop_->targets();
    for (size_t i = 0; i < last_targets_.size(); ++i) {
      fastest_ = std::max(fastest_, std::abs(targets[i] - last_targets_[i]) / loop_->period());
    }
    last_targets_ = targets;
  }
  /** @return The final result of a walk command. */
  CommandResult walk(double vx, double duration) {
    const int64_t id = loop_->hold_walk({vx, 0, 0});
    const auto early = loop_->await_end(id, duration);
    if (early) {
      loop_->release_walk(false);
      return *early;
    }
    loop_->release_walk();
    return loop_->await_end(id, 10).value_or(CommandResult{});
  }
  CommandResult act(const std::string& action) {
    return loop_->await_end(loop_->send_action(action), 30).value_or(CommandResult{});
  }
  double x() { return loop_->torso_in_world().translation().x(); }
  void expect_standing() {
    EXPECT_TRUE(loop_->run_until(
        [&] { return loop_->core().motion_state().posture == loop_->model().ready_posture().name; },
        5));
    EXPECT_LT(loop_->torso_tilt(), 0.1);
  }
  /** The fallback: the next walk is by the gait. */
  void expect_own_gait() {
    const double before = x();
    EXPECT_NE(walk(0.3, 4).status, ResultStatus::kRefused);
    EXPECT_GT(x() - before, 0.4);
  }

  PolicyRobot robot_;
  std::unique_ptr<ClosedLoop> loop_;
  std::vector<double> last_targets_;
  double fastest_ = 0;
};

TEST_F(PolicyMotionTest, AWalkByAPolicyThatHoldsItsDefaultAnglesStands) {
  robot_.add("hold", kWalk, kKnees, 5, {OnnxFile::constant(5, {0, 0})});
  begin("hold");
  const double before = x();
  EXPECT_EQ(walk(0.3, 3).status, ResultStatus::kDone);
  EXPECT_NEAR(x(), before, 0.02);
  expect_standing();
  // Neither the beginning nor the end lets a target jump.
  EXPECT_LT(fastest_, 0.5);
}

TEST_F(PolicyMotionTest, ARobotWithoutAGaitWalksByItsPolicy) {
  robot_.remove("gait.yaml");
  robot_.add("hold", kWalk, kKnees, 5, {OnnxFile::constant(5, {0, 0})});
  begin();
  EXPECT_EQ(walk(0.3, 3).status, ResultStatus::kDone);
  // Another walk is none that it knows.
  act("own-gait");
  EXPECT_EQ(walk(0.3, 3).reason.code, "no-gait");
}

TEST_F(PolicyMotionTest, AnotherMotionTakesOverWithoutAJump) {
  robot_.add("hold", kWalk, kKnees, 5, {OnnxFile::constant(5, {0, 0})});
  begin("hold");
  loop_->hold_walk({0.3, 0, 0});
  loop_->run(2);
  EXPECT_EQ(loop_->core().motion_state().mode, Mode::kWalking);
  loop_->release_walk(false);
  const auto end = loop_->await_end(loop_->send_posture("crouch", 0.3), 15);
  ASSERT_TRUE(end) << to_string(loop_->core().motion_state().mode)
                   << loop_->core().motion_state().command_name;
  EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
  EXPECT_LT(fastest_, 3);
  EXPECT_LT(loop_->torso_tilt(), 0.2);
}

TEST_F(PolicyMotionTest, OutputsThatAreNotFiniteLeaveTheRobotStanding) {
  // Overflows as soon as the velocity rises: 1e38 vx, times 1e38.
  robot_.add("overflow", kWalk, kKnees, 5,
             {{{1e38F, 0, 0, 0, 0}, {0}, ""}, {{1e38F, 0}, {0, 0}, ""}});
  begin("overflow");
  const CommandResult result = walk(0.3, 5);
  EXPECT_EQ(result.status, ResultStatus::kFailed);
  EXPECT_EQ(
      result.reason,
      Reason("policy-stopped", {"overflow", "output 1 of 2, for Left_Knee_Pitch, is not finite"}));
  expect_standing();
  expect_own_gait();
}

TEST_F(PolicyMotionTest, TargetsFasterThanTheMotorLeaveTheRobotStanding) {
  // Each output is 1 minus the last one: the arm shakes.
  robot_.add("shake", kWalk, kArm, 4, {{{0, 0, 0, -1}, {1}, ""}});
  begin("shake");
  const CommandResult result = walk(0.3, 5);
  EXPECT_EQ(result.status, ResultStatus::kFailed);
  EXPECT_EQ(result.reason.code, "policy-stopped");
  EXPECT_THAT(result.reason.arguments.at(1),
              testing::HasSubstr("it moves Left_Shoulder_Pitch at 50.0 rad/s"));
  expect_standing();
  expect_own_gait();
}

TEST_F(PolicyMotionTest, ARobotThatTipsFallsSafelyAndThenUsesItsGait) {
  // Ankles that lean the body ahead.
  robot_.add("lean", kWalk, "  - {name: Left_Ankle_Pitch}\n  - {name: Right_Ankle_Pitch}\n", 5,
             {OnnxFile::constant(5, {-0.6F, -0.6F})});
  begin("lean");
  const CommandResult result = walk(0.3, 5);
  EXPECT_EQ(result.status, ResultStatus::kFailed);
  EXPECT_EQ(result.reason, Reason("policy-stopped", {"lean", "the robot fell"}));
  EXPECT_EQ(loop_->core().motion_state().mode, Mode::kFalling);
}

TEST_F(PolicyMotionTest, ARobotFallsAtTheTiltOfItsPolicy) {
  robot_.add("lean", std::string(kWalk) + "fall_tilt: 0.6\n",
             "  - {name: Left_Ankle_Pitch}\n  - {name: Right_Ankle_Pitch}\n", 5,
             {OnnxFile::constant(5, {-0.6F, -0.6F})});
  begin("lean");
  loop_->hold_walk({0.3, 0, 0});
  EXPECT_TRUE(
      loop_->run_until([&] { return loop_->core().motion_state().mode == Mode::kFalling; }, 5));
  EXPECT_NEAR(loop_->torso_tilt(), 0.6, 0.1);
}

TEST_F(PolicyMotionTest, APolicyIsThePushRecoveryOfARobotThatStands) {
  robot_.add("hold", std::string(kWalk) + "phase: {frequency: 1.5}\nrecovery_margin: 0.02\n",
             kKnees, 5, {OnnxFile::constant(5, {0, 0})});
  begin();
  const double weight = loop_->model().total_mass();
  // The capture point stays on the soles.
  loop_->world().push(0, 0, {0, 0.1 * weight, 0});
  loop_->run(1);
  EXPECT_EQ(loop_->core().motion_state().mode, Mode::kHolding);
  loop_->world().push(0, 0, {0, 0.6 * weight, 0});
  loop_->run(0.1);
  EXPECT_EQ(loop_->core().motion_state().mode, Mode::kWalking);
  EXPECT_EQ(loop_->core().motion_state().command_name, "push-recovery");
  EXPECT_GT(loop_->core().motion_state().walk_velocity.x(), 0);
}

TEST_F(PolicyMotionTest, ARobotThatIsPushedAgainStepsAgain) {
  robot_.add("hold", std::string(kWalk) + "phase: {frequency: 1.5}\nrecovery_margin: -0.06\n",
             kKnees, 5, {OnnxFile::constant(5, {0, 0})});
  begin();
  const double weight = loop_->model().total_mass();
  const auto velocity = [this] { return loop_->core().motion_state().walk_velocity.x(); };
  loop_->world().push(0, 0, {0.25 * weight, 0, 0});
  loop_->run(0.1);
  EXPECT_GT(velocity(), 0);
  // On the way back to the stand.
  ASSERT_TRUE(loop_->run_until([&] { return velocity() == 0; }, 10));
  loop_->run(1);
  ASSERT_EQ(loop_->core().motion_state().command_name, "push-recovery");
  loop_->world().push(0, 0, {0, 0.6 * weight, 0});
  loop_->run(0.1);
  EXPECT_GT(velocity(), 0);
}

TEST_F(PolicyMotionTest, ARemovedFileIsARefusalWithItsName) {
  robot_.add("hold", kWalk, kKnees, 5, {OnnxFile::constant(5, {0, 0})});
  begin("hold");
  std::filesystem::remove(robot_.network_of("hold"));
  const CommandResult result = walk(0.3, 1);
  EXPECT_EQ(result.status, ResultStatus::kRefused);
  EXPECT_EQ(result.reason.code, "policy-unusable");
  EXPECT_THAT(result.reason.arguments.at(1), testing::EndsWith("policy.onnx: was removed"));
  expect_standing();
  expect_own_gait();
}

TEST_F(PolicyMotionTest, AWrongShapeIsRefusedWithTheNumbers) {
  robot_.add("narrow", kWalk, kKnees, 4, {OnnxFile::constant(4, {0, 0})});
  begin("narrow");
  EXPECT_THAT(
      loop_->core().policies().at(0).fault,
      testing::EndsWith("policy.onnx: has 4 inputs, but the manifest lists 5 observations"));
  const CommandResult result = act("narrow");
  EXPECT_EQ(result.status, ResultStatus::kRefused);
  EXPECT_EQ(result.reason.code, "policy-unusable");
  EXPECT_EQ(walk(0.3, 1).status, ResultStatus::kRefused);
  expect_own_gait();
}

TEST_F(PolicyMotionTest, ActionsChooseWhatWalks) {
  robot_.add("hold", kWalk, kKnees, 5, {OnnxFile::constant(5, {0, 0})});
  begin();
  EXPECT_EQ(act("hold").status, ResultStatus::kDone);
  const double before = x();
  EXPECT_EQ(walk(0.3, 2).status, ResultStatus::kDone);
  EXPECT_NEAR(x(), before, 0.02);
  EXPECT_EQ(act("own-gait").status, ResultStatus::kDone);
  expect_own_gait();
}

TEST_F(PolicyMotionTest, AnActionLastsAsLongAsItSays) {
  robot_.add("raise", "kind: action\nduration: 1.5\n", kArm, 4, {OnnxFile::constant(4, {-0.5F})});
  begin();
  const auto arm = static_cast<size_t>(loop_->model().find_motor("Left_Shoulder_Pitch"));
  const double angle = loop_->targets()[arm];
  double highest = 0;
  loop_->on_tick([&] { highest = std::max(highest, angle - loop_->targets()[arm]); });
  const double begin = loop_->time();
  EXPECT_EQ(act("raise").status, ResultStatus::kDone);
  EXPECT_NEAR(highest, 0.5, 1e-6);
  EXPECT_NEAR(loop_->time() - begin, 1.5, 2);
  expect_standing();
}

TEST_F(PolicyMotionTest, AGetUpThatFailsIsFollowedByTheRobotsOwn) {
  robot_.add("lie", "kind: get-up\nduration: 1\n", kArm, 4, {OnnxFile::constant(4, {0})});
  begin();
  // Tips the robot over.
  loop_->world().push(0, 0, {60, 0, 0});
  EXPECT_TRUE(loop_->run_until([&] { return loop_->torso_tilt() > 1.3; }, 5));
  loop_->run(0.5);
  const CommandResult result = act("get-up");
  EXPECT_NE(result.status, ResultStatus::kFailed) << result.reason;
  EXPECT_TRUE(loop_->run_until([&] { return loop_->torso_tilt() < 0.1; }, 30));
}

TEST_F(PolicyMotionTest, AFallenRobotGetsUpByAPolicyFirst) {
  robot_.add("lie", "kind: get-up\nduration: 1\n", kArm, 4, {OnnxFile::constant(4, {0.3F})});
  begin();
  const auto arm = static_cast<size_t>(loop_->model().find_motor("Left_Shoulder_Pitch"));
  const double angle = loop_->targets()[arm] + 0.3;
  double time = 0;
  loop_->on_tick([&] {
    if (std::abs(loop_->targets()[arm] - angle) < 1e-6) time += loop_->period();
  });
  for (int i = 0; i < 2; ++i) {
    time = 0;
    loop_->world().push(0, 0, {60, 0, 0});
    EXPECT_TRUE(loop_->run_until([&] { return loop_->torso_tilt() > 1.3; }, 5)) << i;
    EXPECT_TRUE(loop_->run_until([&] { return loop_->torso_tilt() < 0.1; }, 30)) << i;
    EXPECT_GT(time, 0.2) << i;
    EXPECT_LT(time, 1.1) << i;
    expect_standing();
    loop_->run(3);
  }
}

TEST_F(PolicyMotionTest, AnUnknownPolicyNamesTheKnownOnes) {
  robot_.add("hold", kWalk, kKnees, 5, {OnnxFile::constant(5, {0, 0})});
  try {
    begin("walk");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "the robot has no policy walk; it has hold");
  }
}

/** A T1 with disturbances and its own policies. */
ClosedLoopOptions t1_options(const std::string& disturbances) {
  ClosedLoopOptions options;
  const std::filesystem::path data = NAO_TEST_DATA;
  options.model = std::make_shared<const RobotModel>(RobotModel::load(data / "robots" / "t1"));
  options.scene = SceneFile::load(data / "scenes" / "empty.yaml");
  options.disturbances = std::make_shared<const sim::DisturbanceSet>(
      sim::DisturbanceSet::load(data / "disturbances" / (disturbances + ".yaml")));
  return options;
}

/** Walks by the trained policy for 12.5 s, then stops.
 * @return The distance, m; nothing if it fell, or did not stop as it should. */
std::optional<double> walk_trained(const std::string& disturbances, double vx, uint64_t seed) {
  ClosedLoopOptions options = t1_options(disturbances);
  options.motion.policy = "trained-walk";
  ClosedLoop loop(options, seed);
  loop.run(1);
  const int64_t id = loop.hold_walk({vx, 0, 0});
  loop.run(12.5);
  if (loop.core().motion_state().mode != Mode::kWalking) return std::nullopt;
  loop.release_walk();
  const auto end = loop.await_end(id, 10);
  loop.run(0.5);
  if (!end || end->status != ResultStatus::kDone || loop.torso_tilt() > 0.15) return std::nullopt;
  return loop.torso_in_world().translation().head<2>().norm();
}

// A file in the format of other people's trainers, described by its manifest alone.
TEST(PolicyExample, WalksTheT1) {
  for (const uint64_t seed : {3001, 3002}) EXPECT_GT(walk_trained("default", 0.3, seed), 2.5);
}

// These fell when the policy saw an estimate of the tilt that drifts (531, 560), or when it ended
// at once (509, 513).
TEST(PolicyExample, WalksTheT1FastAndStops) {
  for (const uint64_t seed : {509, 513, 531, 560}) {
    EXPECT_GT(walk_trained("moderate", 1, seed), 8) << "seed " << seed;
  }
}

// By the steps of its gait it withstands 0.44 N s for each kg.
TEST(PolicyExample, CatchesAPushedT1InEveryDirection) {
  for (int direction = 0; direction < 8; ++direction) {
    ClosedLoop loop(t1_options("moderate"), 41);
    loop.run(1);
    const double impulse = 0.9 * loop.model().total_mass();
    const double angle = direction * M_PI / 4;
    loop.world().push(0, 0, {impulse * std::cos(angle), impulse * std::sin(angle), 0});
    loop.run(0.1);
    EXPECT_EQ(loop.core().motion_state().command_name, "push-recovery");
    EXPECT_TRUE(
        loop.run_until([&] { return loop.core().motion_state().mode == Mode::kHolding; }, 12))
        << 45 * direction << " degrees";
    loop.run(0.5);
    EXPECT_LT(loop.torso_tilt(), 0.15);
  }
}

// It fell at 0.31 to 0.45 N s for each kg when a robot that was on its way back to its stand, with
// its feet apart, was pushed.
TEST(PolicyExample, WithstandsTenPushesInARow) {
  ClosedLoop loop(t1_options("default"), 43);
  loop.run(1);
  for (int i = 0; i < 10; ++i) {
    const double impulse = 0.5 * loop.model().total_mass();
    const double angle = loop.random(-M_PI, M_PI);
    loop.world().push(0, 0, {impulse * std::cos(angle), impulse * std::sin(angle), 0});
    loop.run(loop.random(1, 5));
    ASSERT_LT(loop.torso_tilt(), 0.6) << "push " << i;
  }
}

// By the steps of its gait it withstands 0.22 N s for each kg.
TEST(PolicyExample, GoesOnWithAWalkByTheGaitThatIsPushed) {
  for (int i = 0; i < 6; ++i) {
    ClosedLoop loop(t1_options("default"), 44);
    loop.run(0.5);
    const int64_t walk = loop.hold_walk({0.3, 0, 0});
    loop.run(3 + 0.1 * i);
    loop.world().push(0, 0, {0, 0.4 * loop.model().total_mass(), 0});
    loop.run(4);
    const double before = loop.torso_in_world().translation().x();
    loop.run(3);
    EXPECT_EQ(loop.core().motion_state().mode, Mode::kWalking) << i;
    EXPECT_GT(loop.torso_in_world().translation().x() - before, 0.5) << i;
    loop.release_walk();
    const auto end = loop.await_end(walk, 10);
    ASSERT_TRUE(end) << i;
    EXPECT_EQ(end->status, ResultStatus::kDone) << i << " " << end->reason;
    EXPECT_EQ(loop.core().motion_state().mode, Mode::kHolding) << i;
    EXPECT_LT(loop.torso_tilt(), 0.1) << i;
  }
}

// It fell at 0.48 N s for each kg when the foot that swung went on.
TEST(PolicyExample, WalksOnAfterAPushToTheSideAtAnyTime) {
  for (int i = 0; i < 6; ++i) {
    for (const double side : {-1, 1}) {
      ClosedLoopOptions options = t1_options("default");
      options.motion.policy = "trained-balance";
      ClosedLoop loop(options, 41);
      loop.run(0.5);
      loop.hold_walk({0.3, 0, 0});
      loop.run(3 + 0.1 * i);
      loop.world().push(0, 0, {0, side * 0.6 * loop.model().total_mass(), 0});
      loop.run(3);
      EXPECT_EQ(loop.core().motion_state().mode, Mode::kWalking) << i << " " << side;
    }
  }
}

TEST(PolicyRecordTest, HasWhatTheNetworkSawAndDid) {
  PolicyRobot robot("nao");
  robot.add("nod", kWalk, "  - {name: HeadPitch, scale: 0.1, stiffness: 20}\n", 4,
            {{{1, 0, 0, 0}, {0.25F}, ""}});
  const auto model = robot.load();
  MotionOptions options;
  options.policy = "nod";
  MotionCore core(*model, options);
  PerfectRobot body;
  body.settle(core);
  // The velocity rises to the manifest's limit.
  const Command walk{"test", 1, WalkCommand{1, 0, 0}};
  int num_records = 0;
  std::optional<PolicyRecord> last;
  std::vector<double> gains;
  for (int i = 0; i < 300; ++i) {
    const Output output = body.step(core, {walk});
    if (output.policy) last = output.policy;
    num_records += output.policy ? 1 : 0;
    const auto& kp = output.joint_targets->kp;
    if (!kp.empty()) gains.push_back(kp[static_cast<size_t>(model->find_motor("HeadPitch"))]);
  }
  ASSERT_TRUE(last);
  EXPECT_GT(num_records, 40);
  EXPECT_EQ(last->policy, "nod");
  EXPECT_THAT(last->joint_names, testing::ElementsAre("HeadPitch"));
  EXPECT_THAT(last->observation,
              testing::Pointwise(testing::FloatNear(1e-5F), std::vector<float>{0.4F, 0, 0, 0.65F}));
  EXPECT_NEAR(last->action.at(0), 0.65, 1e-5);
  // The gain changes from the servo's own to the policy's in small steps.
  ASSERT_GT(gains.size(), 30u);
  double greatest = 0;
  for (size_t i = 1; i < gains.size(); ++i)
    greatest = std::max(greatest, std::abs(gains[i] - gains[i - 1]));
  EXPECT_EQ(gains.back(), 20);
  EXPECT_GT(std::abs(gains.front() - gains.back()), 1);
  EXPECT_LT(greatest, 0.06 * std::max(gains.front(), gains.back()));
}

}  // namespace
}  // namespace nao::motion
