#include "daemons/motion/walk/servo_feedforward.h"

#include <gtest/gtest.h>

#include "common/constants.h"
#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

using Eigen::Vector3d;

class ServoFeedforwardTest : public testing::Test {
 protected:
  ServoFeedforwardTest() { kinematics_.update(position_); }

  /** Derivative of a function of the joint angles by one angle, by central differences. */
  template <class Function>
  double derivative(int motor, const Function& function) const {
    constexpr double kStep = 1e-6;
    std::vector<double> position = position_;
    Kinematics moved(nao_model());
    position[motor] += kStep;
    moved.update(position);
    const double above = function(moved);
    position[motor] -= 2 * kStep;
    moved.update(position);
    return (above - function(moved)) / (2 * kStep);
  }

  std::vector<double> position_ = nao_model().find_posture("StandInit")->position;
  Kinematics kinematics_{nao_model()};
  ServoFeedforward feedforward_{nao_model()};
  const Vector3d up_ = Vector3d(0.1, -0.05, 1).normalized();
};

TEST_F(ServoFeedforwardTest, TorquesHoldTheWeightOfTheLinks) {
  const std::vector<double> torque = feedforward_.calc_torques(kinematics_, up_, {});
  // Without load on the feet: the gradient of the potential energy.
  const double weight = nao_model().total_mass() * kGravity;
  for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
    const double expected = derivative(
        motor, [&](const Kinematics& moved) { return weight * up_.dot(moved.center_of_mass()); });
    EXPECT_NEAR(torque[motor], expected, 1e-6) << nao_model().motor_joint(motor).name;
  }
}

TEST_F(ServoFeedforwardTest, TorquesCarryTheLoadOnAFoot) {
  const FootLoad load{{3, -2, 40}, kinematics_.left_sole() * Vector3d(0.03, 0.01, 0)};
  const auto unloaded = feedforward_.calc_torques(kinematics_, up_, {});
  const auto loaded = feedforward_.calc_torques(kinematics_, up_, {load, {}});
  for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
    // Virtual work of the force on a point fixed to the sole.
    const double work = derivative(motor, [&](const Kinematics& moved) {
      return load.force.dot(moved.left_sole() * Vector3d(0.03, 0.01, 0));
    });
    EXPECT_NEAR(loaded[motor], unloaded[motor] - work, 1e-6) << nao_model().motor_joint(motor).name;
  }
}

TEST_F(ServoFeedforwardTest, AnOffsetGivesTheTorqueThroughTheServosStiffness) {
  const int knee = nao_model().find_motor("LKneePitch");
  const Motor& motor = nao_model().motor(knee);
  const double peak = nao_model().motor_joint(knee).max_torque;
  const double offset = feedforward_.calc_offset(knee, 0.5 * peak, 0, 1);
  EXPECT_DOUBLE_EQ(offset * motor.stiffness_gain, 0.5 * peak);
  // No more than the motor's peak.
  EXPECT_DOUBLE_EQ(feedforward_.calc_offset(knee, -3 * peak, 0, 1) * motor.stiffness_gain, -peak);
}

TEST_F(ServoFeedforwardTest, AnOffsetCompensatesAFractionOfTheVelocityLosses) {
  const int knee = nao_model().find_motor("LKneePitch");
  const Motor& motor = nao_model().motor(knee);
  const double peak = nao_model().motor_joint(knee).max_torque;
  const double loss = 2 * (motor.damping_gain + peak / motor.no_load_velocity +
                           motor.viscous_friction);  // N m at 2 rad/s
  EXPECT_NEAR(feedforward_.calc_offset(knee, 0, 2, 0.5) * motor.stiffness_gain, 0.5 * loss, 1e-12);
  EXPECT_EQ(feedforward_.calc_offset(knee, 0, 2, 0), 0);
}

}  // namespace
}  // namespace nao::motion
