#include "daemons/motion/commands/command_arbiter.h"

#include <gmock/gmock.h>

#include <limits>

#include "test/daemons/motion/fake_motion.h"
#include "test/daemons/motion/robot_at_rest.h"

namespace nao::motion {
namespace {

using ::testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Command posture(int64_t id, const std::string& name) {
  return {"test", id, PostureCommand{name, 0.5}};
}

Command kick(int64_t id, double strength = kNan) {
  return {"test", id, ActionCommand{"kick-left", kNan, kNan, strength}};
}

class CommandArbiterTest : public ::testing::Test {
 protected:
  /** Results of one command. */
  std::vector<CommandResult> receive(const Command& command, Mode mode = Mode::kHolding) {
    arbiter_.receive(command, robot_.context(), robot_.targets(), mode);
    return arbiter_.take_results();
  }
  /** Runs a fake motion for a command, or for none. */
  void run_fake(std::optional<Command> command) {
    const std::string name = command ? describe(*command) : "own";
    arbiter_.start({std::make_unique<FakeMotion>(fake_), std::move(command), name},
                   robot_.context(), robot_.targets());
  }
  void start_waiting() { arbiter_.start_waiting(robot_.context(), robot_.targets()); }
  auto step() {
    JointTargets targets = robot_.targets();
    return arbiter_.step(robot_.context(0.01), targets);
  }

  MotionOptions options_;
  RobotAtRest robot_;
  JointChangeGuard guard_{nao_model()};
  MotionFactory factory_{nao_model(), options_, guard_};
  CommandArbiter arbiter_{nao_model(), factory_, guard_};
  FakeMotion::Script fake_;
};

TEST_F(CommandArbiterTest, AcceptsACommandAndStartsItsMotion) {
  const auto results = receive(posture(1, "Crouch"));
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status, ResultStatus::kAccepted);
  EXPECT_EQ(arbiter_.running(), nullptr);
  start_waiting();
  ASSERT_NE(arbiter_.running(), nullptr);
  EXPECT_EQ(arbiter_.running()->name, "Crouch");
}

TEST_F(CommandArbiterTest, RefusesWhatTheModeDoesNotAllow) {
  const auto results = receive(posture(1, "Crouch"), Mode::kFalling);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status, ResultStatus::kRefused);
  EXPECT_EQ(results[0].reason, Reason("robot-falling"));
  EXPECT_EQ(arbiter_.last_refusal(), Reason("robot-falling"));
  EXPECT_TRUE(arbiter_.is_idle());
}

TEST_F(CommandArbiterTest, AnswersARepeatedCommandWithItsLatestResult) {
  receive(posture(1, "Lotus"));
  const auto results = receive(posture(1, "Lotus"));
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status, ResultStatus::kRefused);
  EXPECT_EQ(results[0].reason.code, "posture-unknown");
}

TEST_F(CommandArbiterTest, TheNewestOfTwoWaitingCommandsWins) {
  fake_.can_be_replaced = false;
  run_fake(posture(1, "Sit"));
  receive(posture(2, "Crouch"));
  start_waiting();
  const auto results = receive(posture(3, "StandZero"));
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].id, 3);
  EXPECT_EQ(results[1].id, 2);
  EXPECT_EQ(results[1].status, ResultStatus::kInterrupted);
  EXPECT_EQ(results[1].reason, Reason("replaced-before-start"));
}

TEST_F(CommandArbiterTest, AsksAMotionToFinishUntilItCanBeReplaced) {
  fake_.can_be_replaced = false;
  run_fake(posture(1, "Sit"));
  receive(posture(2, "Crouch"));
  for (int i = 0; i < 3; ++i) start_waiting();
  EXPECT_EQ(fake_.num_finishes, 3);
  EXPECT_THAT(arbiter_.take_results(), IsEmpty());
  fake_.can_be_replaced = true;
  start_waiting();
  const auto results = arbiter_.take_results();
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].id, 1);
  EXPECT_EQ(results[0].status, ResultStatus::kInterrupted);
  EXPECT_EQ(results[0].reason, Reason("replaced", {"Crouch"}));
}

TEST_F(CommandArbiterTest, TheRobotsOwnMotionSaysSoWhenItReplacesACommand) {
  run_fake(posture(1, "Sit"));
  FakeMotion::Script own;
  arbiter_.assign({std::make_unique<FakeMotion>(own), std::nullopt, "get-up"});
  start_waiting();
  const auto results = arbiter_.take_results();
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].reason, Reason("replaced-by-motion", {"get-up"}));
  EXPECT_EQ(own.num_starts, 1);
}

TEST_F(CommandArbiterTest, TheEndOfAMotionIsTheResultOfItsCommand) {
  run_fake(posture(1, "Sit"));
  EXPECT_FALSE(step());
  fake_.phase = MotionGenerator::Phase::kFailed;
  fake_.reason = Reason("get-up-failed", {"6"});
  const auto ended = step();
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->phase, MotionGenerator::Phase::kFailed);
  const auto results = arbiter_.take_results();
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status, ResultStatus::kFailed);
  EXPECT_EQ(results[0].reason, Reason("get-up-failed", {"6"}));
  EXPECT_TRUE(arbiter_.is_idle());
}

TEST_F(CommandArbiterTest, AbortsEverythingWithOneReason) {
  fake_.adopts = true;
  fake_.can_be_replaced = false;
  fake_.mode = Mode::kWalking;
  fake_.strike = MotionGenerator::Strike::kPending;
  run_fake(Command{"test", 1, WalkCommand{0.1, 0, 0}});
  receive(kick(2));
  receive({"test", 3, JointChangeCommand{{"HeadYaw"}, {0.3}, false, 1, false}});
  receive(posture(4, "Crouch"));
  arbiter_.abort_all({"robot-fell"});
  std::vector<int64_t> ids;
  for (const CommandResult& result : arbiter_.take_results()) {
    EXPECT_EQ(result.status, ResultStatus::kFailed);
    EXPECT_EQ(result.reason, Reason("robot-fell"));
    ids.push_back(result.id);
  }
  EXPECT_THAT(ids, ::testing::UnorderedElementsAre(1, 2, 3, 4));
  EXPECT_TRUE(arbiter_.is_idle());
  EXPECT_FALSE(arbiter_.has_overlay());
  step();
  EXPECT_THAT(arbiter_.take_results(), IsEmpty());
}

TEST_F(CommandArbiterTest, AWalkWithoutVelocityStartsNoWalk) {
  const auto results = receive({"test", 1, WalkCommand{}});
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[1].status, ResultStatus::kDone);
  EXPECT_EQ(results[1].reason, Reason("not-walking"));
  EXPECT_TRUE(arbiter_.is_idle());
}

TEST_F(CommandArbiterTest, ARunningWalkAdoptsANewerWalk) {
  fake_.adopts = true;
  run_fake(Command{"test", 1, WalkCommand{0.1, 0, 0}});
  const auto results = receive({"test", 2, WalkCommand{0.2, 0, 0}});
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].id, 1);
  EXPECT_EQ(results[0].status, ResultStatus::kInterrupted);
  EXPECT_EQ(results[1].id, 2);
  EXPECT_EQ(results[1].status, ResultStatus::kAccepted);
  EXPECT_EQ(arbiter_.running()->command->id, 2);
  EXPECT_EQ(fake_.num_starts, 1);
}

TEST_F(CommandArbiterTest, AKickDuringAWalkEndsWithTheStrike) {
  fake_.adopts = true;
  fake_.strike = MotionGenerator::Strike::kPending;
  run_fake(Command{"test", 1, WalkCommand{0.1, 0, 0}});
  ASSERT_EQ(receive(kick(2)).size(), 1u);
  step();
  EXPECT_THAT(arbiter_.take_results(), IsEmpty());
  fake_.strike = MotionGenerator::Strike::kMissed;
  step();
  const auto results = arbiter_.take_results();
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].id, 2);
  EXPECT_EQ(results[0].reason, Reason("kick-missed"));
}

TEST_F(CommandArbiterTest, AStrongKickNeedsAStand) {
  fake_.adopts = true;
  run_fake(Command{"test", 1, WalkCommand{0.1, 0, 0}});
  receive(kick(2, 0.9));
  EXPECT_EQ(arbiter_.running()->command->id, 1);
  start_waiting();
  EXPECT_EQ(arbiter_.running()->command->id, 2);
}

TEST_F(CommandArbiterTest, AHeadTurnOverlaysAWalkAndALegDoesNot) {
  fake_.mode = Mode::kWalking;
  run_fake(Command{"test", 1, WalkCommand{0.1, 0, 0}});
  receive({"test", 2, JointChangeCommand{{"HeadYaw"}, {0.3}, false, 1, false}});
  EXPECT_TRUE(arbiter_.has_overlay());
  EXPECT_EQ(arbiter_.running()->command->id, 1);
  receive({"test", 3, JointChangeCommand{{"LKneePitch"}, {0.05}, true, 1, false}});
  start_waiting();
  EXPECT_EQ(arbiter_.running()->command->id, 3);
  EXPECT_FALSE(arbiter_.has_overlay());
}

}  // namespace
}  // namespace nao::motion
