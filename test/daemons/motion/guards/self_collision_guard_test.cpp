#include "daemons/motion/guards/self_collision_guard.h"

#include <gmock/gmock.h>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

/** A straight line of joint angles in small steps. */
std::vector<std::vector<double>> line(const std::vector<double>& from,
                                      const std::vector<double>& to) {
  constexpr int kNumSteps = 100;
  std::vector<std::vector<double>> path;
  for (int k = 0; k <= kNumSteps; ++k) {
    std::vector<double> position = from;
    for (size_t i = 0; i < from.size(); ++i) position[i] += (to[i] - from[i]) * k / kNumSteps;
    path.push_back(position);
  }
  return path;
}

class SelfCollisionGuardTest : public ::testing::Test {
 protected:
  const std::vector<double> stand_ = nao_posture("StandInit");
  SelfCollisionGuard guard_{nao_model()};
  SelfCollision collision_;
};

TEST_F(SelfCollisionGuardTest, StandingPosturesAreFree) {
  for (const char* posture : {"StandZero", "StandInit", "Stand", "Crouch"}) {
    EXPECT_GT(guard_.calc_clearance(nao_posture(posture)), 0) << posture;
  }
}

TEST_F(SelfCollisionGuardTest, AFreePathIsFreeToItsEnd) {
  const auto path = line(stand_, nao_posture("StandZero"));
  EXPECT_EQ(guard_.find_last_free(path, collision_), path.size() - 1);
  EXPECT_EQ(collision_.motor, -1);
}

TEST_F(SelfCollisionGuardTest, AnArmStopsBeforeTheBodyAndTheJointIsNamed) {
  std::vector<double> goal = stand_;
  goal[nao_motor("LShoulderPitch")] = 1.4;
  goal[nao_motor("LShoulderRoll")] = -0.31;
  goal[nao_motor("LElbowYaw")] = -1.0;
  goal[nao_motor("LElbowRoll")] = -1.5;
  const auto path = line(stand_, goal);
  const size_t last = guard_.find_last_free(path, collision_);
  ASSERT_LT(last, path.size() - 1);
  EXPECT_GT(guard_.calc_clearance(path[last]), 0);
  EXPECT_LT(guard_.calc_clearance(path[last + 1]), 0.003);
  ASSERT_GE(collision_.motor, 0);
  EXPECT_EQ(nao_model().motor_joint(collision_.motor).name[0], 'L');
  EXPECT_NE(collision_.link_a, collision_.link_b);
}

TEST_F(SelfCollisionGuardTest, LinksThatTouchMayPart) {
  std::vector<double> touching = stand_;
  touching[nao_motor("LShoulderPitch")] = 1.4;
  touching[nao_motor("LShoulderRoll")] = -0.31;
  touching[nao_motor("LElbowYaw")] = -1.0;
  touching[nao_motor("LElbowRoll")] = -1.5;
  ASSERT_LT(guard_.calc_clearance(touching), 0);
  std::vector<double> apart = touching;
  apart[nao_motor("LShoulderRoll")] = 1.0;
  const auto path = line(touching, apart);
  EXPECT_EQ(guard_.find_last_free(path, collision_), path.size() - 1);
}

}  // namespace
}  // namespace nao::motion
