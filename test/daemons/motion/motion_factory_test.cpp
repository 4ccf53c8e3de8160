#include "daemons/motion/motion_factory.h"

#include <gmock/gmock.h>

#include <limits>

#include "common/error.h"
#include "test/daemons/motion/robot_at_rest.h"

namespace nao::motion {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

class MotionFactoryTest : public ::testing::Test {
 protected:
  /** @return Why there is no motion; none if there is one. */
  Reason plan(decltype(Command::request) request) {
    const MotionPlan plan =
        factory_.plan({"test", 1, std::move(request)}, robot_.context(), robot_.targets());
    const auto* reason = std::get_if<Reason>(&plan);
    return reason == nullptr ? Reason() : *reason;
  }
  Reason plan_action(const std::string& name) {
    return plan(ActionCommand{name, kNotANumber, kNotANumber, kNotANumber});
  }

  MotionOptions options_;
  RobotAtRest robot_;
  JointChangeGuard guard_{nao_model()};
  MotionFactory factory_{nao_model(), options_, guard_};
};

TEST_F(MotionFactoryTest, HasAMotionForEveryActionOfTheRobot) {
  for (const Action& action : nao_model().actions()) {
    EXPECT_EQ(plan_action(action.name), Reason()) << action.name;
  }
}

TEST_F(MotionFactoryTest, RefusesAnActionWithoutAMotion) {
  EXPECT_EQ(plan_action("moonwalk"), Reason("action-without-motion", {"moonwalk"}));
}

TEST_F(MotionFactoryTest, AKeyframeActionStartsFromItsState) {
  robot_ = RobotAtRest("Sit");
  EXPECT_EQ(plan_action("wave"), Reason("action-needs-state", {"wave", "on-feet", "Sit"}));
}

TEST_F(MotionFactoryTest, RefusesToWalkLyingOrLimpOrInTheAir) {
  EXPECT_EQ(plan(WalkCommand{0.1, 0, 0}), Reason());
  robot_.targets().stiffness.assign(nao_model().num_motors(), 0.5);
  EXPECT_EQ(plan(WalkCommand{0.1, 0, 0}), Reason("legs-too-soft", {"50", "60"}));
  EXPECT_EQ(plan(MoveToCommand{1, 0, 0}), Reason("legs-too-soft", {"50", "60"}));
  robot_ = RobotAtRest();
  robot_.sensors().foot_force.assign(robot_.sensors().foot_force.size(), 0);
  robot_.measure();
  EXPECT_EQ(plan(WalkCommand{0.1, 0, 0}), Reason("no-foot-contact"));
  robot_.lay_down({1, 0, 0});
  EXPECT_EQ(plan(WalkCommand{0.1, 0, 0}), Reason("robot-fallen"));
}

TEST_F(MotionFactoryTest, AWalkFromASeatStandsUpFirst) {
  robot_ = RobotAtRest("Sit");
  // No foot need carry weight yet.
  robot_.sensors().foot_force.assign(robot_.sensors().foot_force.size(), 0);
  robot_.measure();
  EXPECT_EQ(plan(WalkCommand{0.1, 0, 0}), Reason());
}

TEST_F(MotionFactoryTest, RefusesABallOutOfReach) {
  const Reason reason = plan(ActionCommand{"kick-left", 1.0, 0.05, kNotANumber});
  EXPECT_EQ(reason.code, "ball-out-of-reach");
  EXPECT_EQ(reason.arguments.size(), 4u);
}

TEST_F(MotionFactoryTest, RefusesAPostureWithoutAPath) {
  options_.transitions = TransitionGraph::parse(nao_model(), "transitions: []");
  MotionFactory factory(nao_model(), options_, guard_);
  const MotionPlan plan =
      factory.plan({"test", 1, PostureCommand{"Sit", 0.5}}, robot_.context(), robot_.targets());
  ASSERT_TRUE(std::holds_alternative<Reason>(plan));
  EXPECT_EQ(std::get<Reason>(plan), Reason("no-path", {"on-feet", "Sit"}));
}

}  // namespace
}  // namespace nao::motion
