#include "daemons/motion/transitions/ankle_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

constexpr double kPeriod = 0.01;  // s
constexpr double kGain = 0.1;     // s

/** Angle that the second of two steps adds to an ankle. @param rate  Of the torso's pitch, rad/s.
 * @param hips_rate  At which the targets of the hips flex, rad/s. */
double added_to_ankle(const char* ankle, double gain, double rate, double hips_rate) {
  AnkleDamping damping(nao_model());
  RobotState state;
  state.angular_velocity_torso = {0.5, rate, -0.4};
  std::vector<double> position;
  double target = 0;
  for (int step = 0; step < 2; ++step) {
    position = nao_posture("StandInit");
    for (const char* hip : {"LHipPitch", "RHipPitch"}) {
      position[nao_motor(hip)] -= step * hips_rate * kPeriod;
    }
    target = position[nao_motor(ankle)];
    damping.add_to(state, gain, kPeriod, position);
  }
  return position[nao_motor(ankle)] - target;
}

TEST(AnkleDamping, BothAnklesTurnWithAPitchThatTheTargetsDoNotCommand) {
  for (const char* ankle : {"LAnklePitch", "RAnklePitch"}) {
    EXPECT_NEAR(added_to_ankle(ankle, kGain, -1, 0), -0.1, 1e-9);
    EXPECT_NEAR(added_to_ankle(ankle, kGain, -1, -2), 0.1, 1e-6);
  }
}

TEST(AnkleDamping, APitchThatTheTargetsCommandAddsNothing) {
  // Over flat soles the torso leans forward as fast as the hips flex.
  EXPECT_NEAR(added_to_ankle("LAnklePitch", kGain, 2, 2), 0, 1e-6);
}

TEST(AnkleDamping, AddsNothingWithoutAGainAndIsLimited) {
  EXPECT_EQ(added_to_ankle("LAnklePitch", 0, -3, 0), 0);
  EXPECT_NEAR(added_to_ankle("LAnklePitch", kGain, -30, 0), -0.4, 1e-9);
}

}  // namespace
}  // namespace nao::motion
