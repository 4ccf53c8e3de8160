#include "daemons/motion/generators/posture_path_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "daemons/motion/transitions/transition_graph.h"
#include "test/daemons/motion/robot_at_rest.h"

namespace nao::motion {
namespace {

using Phase = MotionGenerator::Phase;

constexpr const char* kTransitions = R"(
transitions:
  - {name: up, from: belly, to: on-feet, keyframes: [{duration: 0.5, joints: {HeadYaw: 0.3}}]}
  - {name: up-again, from: belly, to: on-feet, keyframes: [{duration: 0.5, joints: {HeadYaw: -0.3}}]}
  - {name: roll, from: back, to: belly, keyframes: [{duration: 0.5}]}
  - {name: feet-together, from: on-feet, to: on-feet, keyframes: [{duration: 0.2}]}
)";

/** A robot whose joints follow their targets at once, and that lies or stands as the test says. */
class PosturePathMotionTest : public ::testing::Test {
 protected:
  void start(const char* goal, bool is_exact = false) {
    motion_.emplace(graph_, *nao_model().find_posture(goal), 0.5, is_exact);
    motion_->start(robot_.context(), robot_.targets());
  }
  Phase step() {
    const Phase phase = motion_->step(robot_.context(0.01), robot_.targets());
    if (follows_) robot_.sensors().position = robot_.targets().position;
    robot_.measure();
    if (is_lying_) robot_.lay_down({is_on_back_ ? 1.0 : -1.0, 0, 0});
    return phase;
  }
  void lie() {
    is_lying_ = true;
    robot_.lay_down({-1, 0, 0});
  }
  void stand() {
    is_lying_ = false;
    robot_.sensors().accelerometer_torso = {0, 0, kGravity};
    robot_.measure();
  }
  /** @return The phase in which it ended, kRunning after so many s. */
  Phase run(double seconds) {
    Phase phase = Phase::kRunning;
    for (double time = 0; time < seconds && phase == Phase::kRunning; time += 0.01) phase = step();
    return phase;
  }

  const TransitionGraph graph_ = TransitionGraph::parse(nao_model(), kTransitions);
  RobotAtRest robot_;
  std::optional<PosturePathMotion> motion_;
  bool is_lying_ = false;
  bool is_on_back_ = false;
  bool follows_ = true;
};

TEST_F(PosturePathMotionTest, BetweenStandingPosturesTheJointsMoveOnALine) {
  start("Crouch");
  EXPECT_EQ(motion_->mode(), Mode::kMoving);
  step();
  EXPECT_TRUE(motion_->must_stay_upright());
  EXPECT_EQ(run(10), Phase::kDone);
  EXPECT_EQ(robot_.targets().position, nao_posture("Crouch"));
  EXPECT_DOUBLE_EQ(motion_->progress(), 1);
}

TEST_F(PosturePathMotionTest, LimpMotorsBecomeStiffFirst) {
  robot_.targets().stiffness.assign(nao_model().num_motors(), 0.0);
  start("Crouch");
  const std::vector<double> before = robot_.targets().position;
  double last = 0;
  for (int i = 0; i < 49; ++i) {
    step();
    EXPECT_GT(robot_.targets().stiffness[0], last);
    EXPECT_EQ(robot_.targets().position, before);
    last = robot_.targets().stiffness[0];
  }
  EXPECT_EQ(run(10), Phase::kDone);
  EXPECT_DOUBLE_EQ(robot_.targets().stiffness[0], 1);
}

TEST_F(PosturePathMotionTest, GetsUpAlongATransitionAndContinuesOnALine) {
  lie();
  start("StandInit");
  while (motion_->can_be_replaced()) ASSERT_EQ(step(), Phase::kRunning);
  EXPECT_FALSE(motion_->must_stay_upright());
  for (int i = 0; i < 30; ++i) step();
  stand();
  EXPECT_EQ(run(10), Phase::kDone);
  MotionState state;
  motion_->describe(state);
  EXPECT_EQ(state.num_tries, 1);
}

TEST_F(PosturePathMotionTest, AMomentWithoutLoadOnTheFeetAfterTheGetUpDoesNotEndIt) {
  lie();
  start("StandInit");
  while (motion_->can_be_replaced()) ASSERT_EQ(step(), Phase::kRunning);
  for (int i = 0; i < 30; ++i) step();
  stand();
  // The transition ends on the feet, which the rising body then takes the load off.
  while (!motion_->can_be_replaced()) ASSERT_EQ(step(), Phase::kRunning);
  const std::vector<double> load = robot_.sensors().foot_force;
  robot_.sensors().foot_force.assign(load.size(), 0.0);
  robot_.measure();
  EXPECT_EQ(run(0.2), Phase::kRunning);
  robot_.sensors().foot_force = load;
  EXPECT_EQ(run(10), Phase::kDone);
}

// Commands that the mode refuses would otherwise end it while it rests.
TEST_F(PosturePathMotionTest, APostureThatTheGetUpReachedNeedsNoFurtherMotion) {
  const auto graph = TransitionGraph::parse(nao_model(), R"(
transitions:
  - {name: up, from: belly, to: on-feet, keyframes: [{duration: 0.3, posture: StandInit}]}
)");
  const int knee = nao_motor("LKneePitch");
  robot_.targets().position[knee] += 0.5;
  robot_.sensors().position = robot_.targets().position;
  lie();
  motion_.emplace(graph, *nao_model().find_posture("StandInit"), 0.5);
  motion_->start(robot_.context(), robot_.targets());
  while (motion_->progress() < 0.45) {
    const double before = robot_.targets().position[knee];
    ASSERT_EQ(step(), Phase::kRunning);
    robot_.targets().velocity[knee] = (robot_.targets().position[knee] - before) / 0.01;
  }
  stand();
  int num_steps = 0;
  for (; step() == Phase::kRunning; ++num_steps) ASSERT_LT(num_steps, 10);
  EXPECT_LE(num_steps, 6);  // of which the transition takes up to four
}

TEST_F(PosturePathMotionTest, GetsUpFromItsStartUntilItIsOnItsFeetAlsoWhileItRests) {
  lie();
  start("StandInit");
  EXPECT_EQ(motion_->mode(), Mode::kGettingUp);
  int num_rests = 0;
  bool rested = true;
  // Long enough for a transition that fails, a rest, and the next transition.
  for (int i = 0; i < 100; ++i) {
    step();
    EXPECT_EQ(motion_->mode(), Mode::kGettingUp) << i;
    num_rests += motion_->can_be_replaced() && !rested ? 1 : 0;
    rested = motion_->can_be_replaced();
  }
  EXPECT_GE(num_rests, 1);
  stand();
  while (!motion_->can_be_replaced()) step();
  EXPECT_EQ(motion_->mode(), Mode::kMoving);
}

TEST_F(PosturePathMotionTest, ALyingRobotThatMovesItsJointsOnlyDoesNotGetUp) {
  lie();
  start("LyingBelly");
  while (motion_->progress() == 0) ASSERT_EQ(step(), Phase::kRunning);
  EXPECT_EQ(motion_->mode(), Mode::kMoving);
}

TEST_F(PosturePathMotionTest, TriesAnotherTransitionAfterAFailure) {
  const int head = nao_motor("HeadYaw");
  lie();
  start("StandInit");
  double greatest = 0;
  double least = 0;
  for (int i = 0; i < 200; ++i) {
    step();
    greatest = std::max(greatest, robot_.targets().position[head]);
    least = std::min(least, robot_.targets().position[head]);
  }
  EXPECT_NEAR(greatest, 0.3, 1e-9);
  EXPECT_NEAR(least, -0.3, 1e-9);
}

TEST_F(PosturePathMotionTest, AFailedRollDoesNotChangeTheGetUpMotionAfterIt) {
  const int head = nao_motor("HeadYaw");
  is_on_back_ = true;
  is_lying_ = true;
  robot_.lay_down({1, 0, 0});
  start("StandInit");
  // A roll fails; the second one succeeds, and the get-up motion after it is played to its end.
  for (int i = 0; i < 100; ++i) step();
  is_on_back_ = false;
  double least = 0;
  double greatest = 0;
  for (int i = 0; i < 75; ++i) {
    step();
    least = std::min(least, robot_.targets().position[head]);
    greatest = std::max(greatest, robot_.targets().position[head]);
  }
  EXPECT_NEAR(greatest, 0.3, 1e-9);
  EXPECT_EQ(least, 0);
}

TEST_F(PosturePathMotionTest, WaitsAtAKeyframeForABodyThatIsLate) {
  const TransitionGraph graph = TransitionGraph::parse(nao_model(), R"(
transitions:
  - {name: up, from: belly, to: on-feet, keyframes: [
      {duration: 0.5, joints: {HeadYaw: 0.3}, up: {z: [0.5, 1]}}, {duration: 0.5, joints: {HeadYaw: 0.6}}]}
)");
  const int head = nao_motor("HeadYaw");
  for (const bool stands : {true, false}) {
    lie();
    motion_.emplace(graph, *nao_model().find_posture("StandInit"), 0.5);
    motion_->start(robot_.context(), robot_.targets());
    double greatest = 0;
    const auto run_and_see = [&](double seconds) {
      for (double time = 0; time < seconds; time += 0.01) {
        step();
        greatest = std::max(greatest, robot_.targets().position[head]);
      }
    };
    // It rests for 0.1 s before the transition.
    run_and_see(0.8);
    EXPECT_NEAR(greatest, 0.3, 0.02);
    if (stands) stand();
    run_and_see(0.8);
    EXPECT_NEAR(greatest, stands ? 0.6 : 0.3, 0.02);
  }
}

TEST_F(PosturePathMotionTest, GivesUpAfterSixTries) {
  lie();
  start("StandInit");
  EXPECT_EQ(run(60), Phase::kFailed);
  EXPECT_EQ(motion_->reason(), Reason("get-up-failed", {"6"}));
  // It lies, and its joints are soft.
  EXPECT_THAT(robot_.targets().stiffness, testing::Each(0.1));
}

TEST_F(PosturePathMotionTest, FailsWithoutAPath) {
  start("Sit");
  EXPECT_EQ(run(5), Phase::kFailed);
  EXPECT_EQ(motion_->reason(), Reason("no-path", {"on-feet", "Sit"}));
}

TEST_F(PosturePathMotionTest, ABlockedJointBringsTheFeetTogetherBeforeItFails) {
  follows_ = false;
  start("Crouch");
  EXPECT_EQ(run(60), Phase::kFailed);
  EXPECT_EQ(motion_->reason().code, "posture-not-reached");
}

TEST_F(PosturePathMotionTest, BringsTheFeetTogetherOnceIfThePostureShallBeExact) {
  const int hip = nao_motor("LHipRoll");
  for (const bool is_exact : {false, true}) {
    robot_.sensors().position = nao_posture("StandInit");
    robot_.targets().position = nao_posture("StandInit");
    robot_.measure();
    start("StandInit", is_exact);
    double progress = 0;
    double least = 1;
    // The floor keeps the foot off by 3 degrees, which is below 5 degrees and counts as reached.
    for (Phase phase = Phase::kRunning; phase == Phase::kRunning;) {
      phase = motion_->step(robot_.context(0.01), robot_.targets());
      robot_.sensors().position = robot_.targets().position;
      robot_.sensors().position[hip] += 0.052;
      robot_.measure();
      // Progress of the transition starts at 0 again.
      if (progress == 1) least = std::min(least, motion_->progress());
      progress = std::max(progress, motion_->progress());
      EXPECT_NE(phase, Phase::kFailed);
    }
    EXPECT_EQ(least < 0.5, is_exact);
  }
}

TEST_F(PosturePathMotionTest, GetsUpAgainAfterAFallThatBlocksAJoint) {
  start("Crouch");
  for (int i = 0; i < 10; ++i) step();
  lie();
  follows_ = false;
  bool gets_up = false;
  for (int i = 0; i < 600 && !gets_up; ++i) {
    ASSERT_EQ(step(), Phase::kRunning);
    gets_up = motion_->mode() == Mode::kGettingUp;
  }
  EXPECT_TRUE(gets_up);
}

TEST_F(PosturePathMotionTest, EndsBetweenTwoSegmentsWhenAskedTo) {
  lie();
  start("StandInit");
  while (motion_->can_be_replaced()) ASSERT_EQ(step(), Phase::kRunning);
  motion_->finish();
  EXPECT_FALSE(motion_->can_be_replaced());
  for (int i = 0; i < 100; ++i) EXPECT_EQ(step(), Phase::kRunning);
  EXPECT_TRUE(motion_->can_be_replaced());
}

}  // namespace
}  // namespace nao::motion
