#include "daemons/motion/generators/walk_motion.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/walk/ideal_walker.h"

namespace nao::motion {
namespace {

class WalkMotionTest : public testing::Test {
 protected:
  /** Walks forward for a time in ticks of dt. @return Distance, m. */
  double walk(double duration, double period, double dt) {
    IdealWalker walker;
    WalkMotion motion(nao_model(), gait_, nullptr, command_);
    sensors_.period = period;
    const MotionContext context{nao_model(),         options_, sensors_, walker.state(),
                                walker.kinematics(), dt};
    motion.start(context, walker.targets());
    for (double time = 0; time < duration - 1e-9; time += dt) {
      EXPECT_TRUE(motion.adopt({"test", 1, command_}));
      EXPECT_EQ(motion.step(context, walker.targets()), MotionGenerator::Phase::kRunning);
      walker.measure();
    }
    return walker.torso().position.x();
  }

  const Gait gait_ = ideal_gait();
  const MotionOptions options_{};
  const WalkCommand command_{0.15, 0, 0};
  Sensors sensors_;
};

TEST_F(WalkMotionTest, WalksAtTheSameVelocityAtAnyControlPeriod) {
  const double distance = walk(10, 0.01, 0.01);
  EXPECT_NEAR(distance, 0.15 * 9.3, 0.1);
  // A NAO V6 has 12 ms.
  EXPECT_NEAR(walk(10, 0.012, 0.012), distance, 0.03 * distance);
}

TEST_F(WalkMotionTest, AdvancesByOneControlPeriodAfterMissedTicks) {
  // Every second tick was missed, in which the servos held their targets.
  EXPECT_NEAR(walk(20, 0.01, 0.02), walk(10, 0.01, 0.01), 1e-9);
}

}  // namespace
}  // namespace nao::motion
