#include "daemons/motion/walk/step_planner.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStandLead = 0.02;  // m

/** The NAO's gait, which learns no deviation, with a gain for it. */
Gait learning_gait() {
  Gait gait = nao_gait();
  gait.feedback.bias_gain = 0.04;
  return gait;
}

class StepPlannerTest : public testing::Test {
 protected:
  StepPlannerTest() {
    const Pose2 right = FootstepPlanner(nao_model(), gait_).square_step(true);
    feet_.start(right);
    reference_.start(feet_.midpoint(), 0.26);
    planner_.start();
  }

  void plan(const Vector3d& velocity, bool is_ending = false) {
    planner_.begin_step(is_ending);
    planner_.plan(feet_, reference_, velocity, is_ending, gait_.timing.step_duration);
  }
  /** Lands on the foothold; the swing foot becomes the support foot. */
  void land() {
    const Spread spread = planner_.end_step(feet_, Vector3d::Zero());
    feet_.swing().start(planner_.foothold(), 0);
    reference_.change_frame(feet_.exchange(spread));
  }
  /** Moves the reference to a DCM without changing the center of mass. */
  PendulumState with_dcm(const Vector2d& dcm) const {
    const Vector2d com = reference_.state().position;
    return {com, reference_.omega() * (dcm - com)};
  }

  const Gait gait_ = learning_gait();
  Feet feet_{gait_};
  ComReference reference_{gait_};
  StepPlanner planner_{nao_model(), gait_, kStandLead};
};

TEST_F(StepPlannerTest, PlansADcmThatObeysThePendulumUntilTheLastFootstep) {
  plan({0.2, 0.05, 0.3});
  const auto& steps = planner_.footsteps();
  ASSERT_EQ(steps.size(), 5u);
  const double omega = reference_.omega();
  const double duration = gait_.timing.step_duration;
  Vector2d dcm = advance_dcm(planner_.dcm().start, feet_.support_zmp(), omega, duration);
  EXPECT_NEAR((dcm - planner_.dcm().end).norm(), 0, 1e-12);
  for (size_t i = 0; i + 1 < steps.size(); ++i) {
    dcm = advance_dcm(dcm, steps[i].pose * feet_.nominal_zmp(steps[i].is_left), omega, duration);
  }
  const auto zmp = [&](const PlannedStep& step) -> Vector2d {
    return step.pose * feet_.nominal_zmp(step.is_left);
  };
  EXPECT_NEAR((dcm - 0.5 * (zmp(steps[3]) + zmp(steps[4]))).norm(), 0, 1e-9);
}

TEST_F(StepPlannerTest, TheLastStepsLeadToRestBetweenTheFeet) {
  // A walk forward at full speed, whose center of mass follows the plan.
  const double omega = reference_.omega();
  const double duration = gait_.timing.step_duration;
  PendulumState com = with_dcm([&] {
    plan({0.3, 0, 0});
    return planner_.dcm().start;
  }());
  const auto follow = [&](const Vector3d& velocity, bool is_ending) {
    // The reference gives the planner the DCM.
    reference_.rest_at(com.position);
    reference_.follow(com, 1e9);
    plan(velocity, is_ending);
    // The ZMP that realizes the planned end point; it is within reach.
    const Vector2d zmp = zmp_between_dcms(com.dcm(omega), planner_.dcm().end, omega, duration);
    com = advance(com, zmp, omega, duration);
    const Pose2 to_new = planner_.foothold().inverse();
    land();
    com = {to_new * com.position, to_new.rotate(com.velocity)};
  };
  for (int i = 0; i < 6; ++i) follow({0.3, 0, 0}, false);
  EXPECT_GT(com.velocity.x(), 0.2);
  int num_steps = 0;
  do {
    follow({0, 0, 0}, true);
    ++num_steps;
  } while (!planner_.is_square(feet_) && num_steps < 5);
  EXPECT_LE(num_steps, 2);
  // A ZMP at the DCM brings the pendulum to rest there.
  com = advance(com, com.dcm(omega), omega, 2);
  EXPECT_NEAR((com.position - planner_.rest_point(feet_)).norm(), 0, 1e-6);
  EXPECT_NEAR(com.velocity.norm(), 0, 1e-4);
  EXPECT_NEAR(planner_.rest_point(feet_).x() - feet_.midpoint().x(), kStandLead, 1e-12);
}

TEST_F(StepPlannerTest, MovesTheFootholdByTheDeviationOfTheDcm) {
  plan({0.1, 0, 0});
  const Vector2d planned = planner_.foothold().position;
  const Vector2d deviation(0.01, -0.02);  // outward: the right foot swings
  planner_.adapt_foothold(feet_, planner_.dcm().end + deviation);
  EXPECT_NEAR((planner_.foothold().position - planned - deviation).norm(), 0, 1e-12);
  // No farther than the leg reaches.
  planner_.adapt_foothold(feet_, planner_.dcm().end + Vector2d(1, 1));
  EXPECT_DOUBLE_EQ(planner_.foothold().position.x(), gait_.step_limits.max_forward);
  EXPECT_DOUBLE_EQ(planner_.foothold().position.y(), -gait_.step_limits.min_foot_separation);
}

TEST_F(StepPlannerTest, LearnsADeviationThatEveryStepOfAFootHas) {
  const Vector2d deviation(0.004, -0.006);
  for (int i = 0; i < 400; ++i) {
    plan(Vector3d::Zero());
    // Steps on the left foot deviate, steps on the right foot do not.
    const Vector2d actual = feet_.support_is_left() ? deviation : Vector2d(0, 0);
    planner_.adapt_foothold(feet_, planner_.dcm().end + actual);
    const Vector2d moved =
        planner_.foothold().position - planner_.footsteps().front().pose.position;
    if (i < 2 && feet_.support_is_left()) {
      EXPECT_NEAR((moved - deviation).norm(), 0, 1e-12);
    }
    if (i >= 398) {
      EXPECT_LT(moved.norm(), 1e-4) << i;
    }
    land();
  }
}

TEST_F(StepPlannerTest, FeetAreSquareAfterAStepInPlaceOnly) {
  EXPECT_TRUE(planner_.is_square(feet_));
  plan({0.2, 0, 0});
  land();
  EXPECT_FALSE(planner_.is_square(feet_));
  plan(Vector3d::Zero());
  land();
  EXPECT_TRUE(planner_.is_square(feet_));
}

}  // namespace
}  // namespace nao::motion
