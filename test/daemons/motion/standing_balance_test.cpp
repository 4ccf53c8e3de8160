#include "daemons/motion/standing_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "nao_model.h"
#include "test/daemons/motion/moving_robot.h"

namespace nao::motion {
namespace {

class StandingBalanceTest : public ::testing::Test {
 protected:
  StandingBalanceTest() {
    gains_.ankle_pitch = 0.04;
    gains_.hip_pitch = 0.08;
    gains_.least_rate = 0.1;
    gains_.step_margin = 0.03;
  }

  /** Whether a robot that moves, m/s, steps then. */
  bool steps_at(double ahead, double left) const {
    return StandingBalance(gains_, legs_).must_step(moving(ahead, left));
  }

  /** Angles that a torso's pitch rate, rad/s, adds. */
  std::vector<double> added_at(double rate) const {
    RobotState state;
    state.angular_velocity_torso = {0.3, rate, 0.2};
    std::vector<double> position(model_.num_motors(), 0.0);
    StandingBalance(gains_, legs_).add_to(state, position);
    return position;
  }

  /** Angle of a joint about the torso's y axis. */
  double pitch(const std::vector<double>& position, Leg leg, auto role) const {
    const LegRoles& roles = legs_.roles(leg);
    return roles.sign[roles.*role] * position[legs_.motors(leg)[roles.*role]];
  }

  const RobotModel& model_ = nao_model();
  const LegKinematics legs_{model_};
  Gait::Standing gains_;
};

TEST_F(StandingBalanceTest, AnklesAndHipsOfBothLegsTurnWithWhatTheRateExceedsTheLeastOneBy) {
  for (const double rate : {1.1, -1.1}) {
    const std::vector<double> added = added_at(rate);
    const double excess = rate > 0 ? 1.0 : -1.0;
    double others = 0;
    for (const double angle : added) others += std::abs(angle);
    for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
      EXPECT_NEAR(pitch(added, leg, &LegRoles::ankle_pitch), 0.04 * excess, 1e-12);
      EXPECT_NEAR(pitch(added, leg, &LegRoles::hip_pitch), 0.08 * excess, 1e-12);
      others -= 0.12;
    }
    EXPECT_NEAR(others, 0, 1e-12);
  }
}

TEST_F(StandingBalanceTest, NoiseBelowTheLeastRateMovesNothing) {
  for (const double rate : {-0.1, -0.03, 0.0, 0.1}) {
    EXPECT_EQ(added_at(rate), std::vector<double>(model_.num_motors(), 0.0));
  }
}

// The capture point is ahead of the center of mass by 0.319 s times the velocity.
TEST_F(StandingBalanceTest, StepsWhenThePointWhereItComesToRestNearsTheToesOrTheHeels) {
  EXPECT_TRUE(steps_at(0.23, 0));
  EXPECT_FALSE(steps_at(0.21, 0));
  EXPECT_TRUE(steps_at(-0.23, 0.1));
  EXPECT_FALSE(steps_at(0.1, 1));
  // Slower than a push: it leans.
  gains_.step_margin = 0.05;
  EXPECT_FALSE(steps_at(0.19, 0));
  gains_.step_margin = -0.02;
  EXPECT_FALSE(steps_at(0.35, 0));
  EXPECT_TRUE(steps_at(0.4, 0));
  // Lifted.
  RobotState state;
  state.center_of_mass_velocity_in_odometry = {1, 0, 0};
  EXPECT_FALSE(StandingBalance(gains_, legs_).must_step(state));
}

}  // namespace
}  // namespace nao::motion
