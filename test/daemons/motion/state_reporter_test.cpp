#include "daemons/motion/state_reporter.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/fake_motion.h"
#include "test/daemons/motion/robot_at_rest.h"

namespace nao::motion {
namespace {

class StateReporterTest : public ::testing::Test {
 protected:
  std::optional<MotionState> update(double dt, Mode mode = Mode::kHolding) {
    return reporter_.update({robot_.context(dt), robot_.targets(), arbiter_, mode, needs_help_},
                            dt);
  }
  int count_reports(double dt, double seconds) {
    int num_reports = 0;
    const auto num_steps = static_cast<int>(std::lround(seconds / dt));
    for (int i = 0; i < num_steps; ++i) num_reports += update(dt).has_value() ? 1 : 0;
    return num_reports;
  }

  MotionOptions options_;
  RobotAtRest robot_;
  JointChangeGuard guard_{nao_model()};
  MotionFactory factory_{nao_model(), options_, guard_};
  CommandArbiter arbiter_{nao_model(), factory_, guard_};
  StateReporter reporter_{0.1};
  bool needs_help_ = false;
};

TEST_F(StateReporterTest, ReportsTenTimesASecondAtAnyControlPeriod) {
  for (const double dt : {0.008, 0.01, 0.012, 0.03}) {
    update(dt);
    EXPECT_NEAR(count_reports(dt, 6), 60, 1) << dt;
  }
}

TEST_F(StateReporterTest, ReportsAChangeAtOnce) {
  EXPECT_TRUE(update(0.01, Mode::kMoving));
  EXPECT_FALSE(update(0.01, Mode::kMoving));
  EXPECT_TRUE(update(0.01, Mode::kHolding));
  needs_help_ = true;
  EXPECT_TRUE(update(0.01));
}

TEST_F(StateReporterTest, APauseOfSeveralPeriodsGivesOneReport) {
  update(0.01);
  EXPECT_TRUE(update(1.0));
  EXPECT_FALSE(update(0.01));
}

TEST_F(StateReporterTest, NamesThePostureOnlyWhileNoMotionRuns) {
  update(0.01);
  EXPECT_EQ(reporter_.state().posture, "StandInit");
  FakeMotion::Script script;
  arbiter_.start(
      {std::make_unique<FakeMotion>(script), Command{"me", 7, PostureCommand{"Sit", 1}}, "Sit"},
      robot_.context(), robot_.targets());
  const auto state = update(0.01, Mode::kMoving);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->posture, "");
  EXPECT_EQ(state->command_kind, CommandKind::kPosture);
  EXPECT_EQ(state->command_name, "Sit");
  EXPECT_EQ(state->command_source, "me");
  EXPECT_EQ(state->command_id, 7);
}

TEST_F(StateReporterTest, AMotionWithoutACommandHasANameOnly) {
  FakeMotion::Script script;
  arbiter_.start({std::make_unique<FakeMotion>(script), std::nullopt, "get-up"}, robot_.context(),
                 robot_.targets());
  const auto state = update(0.01, Mode::kGettingUp);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->command_kind, std::nullopt);
  EXPECT_EQ(state->command_name, "get-up");
  EXPECT_EQ(state->command_source, "");
}

TEST_F(StateReporterTest, CarriesTheReasonOfTheLastRefusal) {
  arbiter_.receive({"me", 1, PostureCommand{"Lotus", 1}}, robot_.context(), robot_.targets(),
                   Mode::kHolding);
  EXPECT_EQ(update(0.01)->last_refusal.code, "posture-unknown");
}

}  // namespace
}  // namespace nao::motion
