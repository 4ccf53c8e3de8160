#include "daemons/motion/walk/walk_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "test/daemons/motion/walk/ideal_walker.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Stage = WalkEngine::Stage;

class WalkEngineTest : public testing::Test {
 protected:
  WalkEngineTest() { engine_.start(walker_.targets()); }

  /** One tick. @return false when the walk has ended. */
  bool step(double dt = 0.01) {
    const bool walks = engine_.step(walker_.state(), walker_.kinematics(), dt, walker_.targets());
    walker_.measure();
    return walks;
  }
  void walk(double duration, double dt = 0.01) {
    for (double time = 0; time < duration - 1e-9; time += dt) step(dt);
  }
  /** Mean velocity in the body frame over a time that is a multiple of two steps, about. */
  Vector3d measure_velocity(double duration, double dt) {
    Vector3d sum = Vector3d::Zero();
    Pose2 last = walker_.torso();
    double time = 0;
    for (; time < duration; time += dt) {
      step(dt);
      const Pose2 moved = last.inverse() * walker_.torso();
      sum += Vector3d(moved.position.x(), moved.position.y(), wrapped(moved.heading));
      last = walker_.torso();
    }
    return sum / time;
  }

  const Gait gait_ = ideal_gait();
  WalkEngine engine_{nao_model(), gait_, *nao_model().find_posture("StandInit")};
  IdealWalker walker_;
};

TEST_F(WalkEngineTest, GoesThroughItsStagesAndEndsInThePosture) {
  std::vector<Stage> stages = {engine_.stage()};
  const auto note = [&] {
    if (engine_.stage() != stages.back()) stages.push_back(engine_.stage());
  };
  engine_.set_velocity({0.1, 0, 0});
  for (int i = 0; i < 300; ++i) {
    step();
    note();
  }
  engine_.end();
  for (int i = 0; i < 500 && step(); ++i) note();
  note();
  EXPECT_EQ(stages, (std::vector<Stage>{Stage::kLowering, Stage::kStarting, Stage::kStepping,
                                        Stage::kStopping, Stage::kRaising, Stage::kDone}));
  const std::vector<double>& posture = nao_model().find_posture("StandInit")->position;
  for (int motor : engine_.legs().motors(Leg::kLeft)) {
    EXPECT_NEAR(walker_.targets().position[motor], posture[motor], 1e-6);
  }
}

TEST_F(WalkEngineTest, WalksAtTheCommandedVelocityWhateverTheControlPeriod) {
  for (const Vector3d& commanded :
       {Vector3d(0.2, 0, 0), Vector3d(-0.1, 0, 0), Vector3d(0, 0.1, 0), Vector3d(0, 0, 0.8)}) {
    const auto measure = [&](double dt) {
      walker_ = IdealWalker();
      engine_.start(walker_.targets());
      engine_.set_velocity(commanded);
      walk(3, dt);
      return measure_velocity(8, dt);
    };
    const Vector3d at_10_ms = measure(0.01);
    // The torso turns about a point 3 cm ahead of it.
    const double allowed = 0.05 * commanded.norm();
    EXPECT_NEAR((at_10_ms - commanded).norm(), 0, allowed) << at_10_ms.transpose();
    for (const double dt : {0.008, 0.012}) {
      const Vector3d velocity = measure(dt);
      EXPECT_NEAR((velocity - at_10_ms).norm(), 0, 0.035 * commanded.norm())
          << dt << " s: " << velocity.transpose() << "; 10 ms: " << at_10_ms.transpose();
    }
  }
}

TEST_F(WalkEngineTest, ItsFirstFootstepGoesToTheSideOfTheWalk) {
  for (const double vy : {0.1, -0.1}) {
    walker_ = IdealWalker();
    engine_.start(walker_.targets());
    engine_.set_velocity({0, vy, 0});
    while (engine_.stage() != Stage::kStepping) step();
    ASSERT_FALSE(engine_.footsteps_in_odometry().empty());
    EXPECT_EQ(engine_.footsteps_in_odometry().front().is_left, vy > 0);
  }
}

TEST_F(WalkEngineTest, ItsFootstepsAreWhereTheFeetLand) {
  engine_.set_velocity({0.15, 0, 0});
  walk(3);
  Pose2 planned;
  bool is_left = false;
  int num_landings = 0;
  for (int i = 0; i < 300; ++i) {
    const PlannedStep next = engine_.footsteps_in_odometry().front();
    if (next.is_left != is_left && i > 0) {
      // Seen in the tick of the change too: beside the new support foot, not beyond it.
      const Pose2 step = engine_.midpoint_in_odometry().inverse() * next.pose;
      EXPECT_GT((next.is_left ? 1 : -1) * step.position.y(), 0.02);
      EXPECT_LT((next.is_left ? 1 : -1) * step.position.y(), 0.1);
      const Pose2 landed = Pose2::from(is_left ? walker_.state().left_sole_in_odometry
                                               : walker_.state().right_sole_in_odometry);
      EXPECT_LT((landed.position - planned.position).norm(), 0.01);
      ++num_landings;
    }
    planned = next.pose;
    is_left = next.is_left;
    step();
  }
  EXPECT_GE(num_landings, 10);
}

TEST_F(WalkEngineTest, StopsWithinTwoStepsAndStaysThere) {
  engine_.set_velocity({0.3, 0, 0});
  walk(4);
  const Vector2d start = walker_.torso().position;
  engine_.end();
  double time = 0;
  while (engine_.stage() == Stage::kStepping) {
    step();
    time += 0.01;
  }
  EXPECT_LE(time, 2.5 * gait_.timing.max_step_duration);
  const Vector2d stopped = walker_.torso().position;
  EXPECT_LT((stopped - start).norm(), 0.2);
  while (step()) {
  }
  EXPECT_LT((walker_.torso().position - stopped).norm(), 0.03);
}

TEST_F(WalkEngineTest, WalksOnWhenTheEndIsWithdrawn) {
  engine_.set_velocity({0.2, 0, 0});
  walk(3);
  engine_.end();
  walk(0.1);
  engine_.resume();
  walk(2);
  EXPECT_EQ(engine_.stage(), Stage::kStepping);
  EXPECT_NEAR(engine_.velocity().x(), 0.2, 1e-12);
}

TEST_F(WalkEngineTest, EndsWithoutAStepWhenItHasNotStarted) {
  engine_.end();
  for (int i = 0; i < 500 && step(); ++i) EXPECT_NE(engine_.stage(), Stage::kStepping);
  EXPECT_EQ(engine_.stage(), Stage::kDone);
}

TEST_F(WalkEngineTest, KicksWithTheRequestedFoot) {
  for (const bool with_left : {true, false}) {
    walker_ = IdealWalker();
    engine_.start(walker_.targets());
    engine_.set_velocity({0.1, 0, 0});
    walk(3);
    engine_.kick().request(with_left, std::nullopt);
    double highest = 0;
    for (int i = 0; i < 100; ++i) {
      step();
      const auto& foot = with_left ? walker_.state().left_sole_in_odometry
                                   : walker_.state().right_sole_in_odometry;
      highest = std::max(highest, foot.translation().z());
    }
    EXPECT_EQ(engine_.kick().state(), WalkKick::State::kStruck);
    EXPECT_NEAR(highest, gait_.swing.height + gait_.kick.swing_lift, 0.005);
    EXPECT_EQ(engine_.stage(), Stage::kStepping);
  }
}

TEST_F(WalkEngineTest, MovesAllTargetsSmoothly) {
  engine_.set_velocity({0.2, 0.05, 0.3});
  std::vector<double> last = walker_.targets().position;
  double fastest = 0;
  for (int i = 0; i < 400; ++i) {
    step();
    for (size_t motor = 0; motor < last.size(); ++motor) {
      fastest = std::max(fastest, std::abs(walker_.targets().position[motor] - last[motor]) / 0.01);
    }
    last = walker_.targets().position;
  }
  EXPECT_LT(fastest, 6);  // rad/s; the slowest leg motor turns at 4.2, the fastest at 6.4
}

}  // namespace
}  // namespace nao::motion
