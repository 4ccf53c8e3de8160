// Programs die or hang at random moments while the robot stands, walks or lies.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <random>

#include "test/daemons/robot/robot_loop.h"

namespace nao::robot {
namespace {

/** Moments of each fault: NAO_FAULT_MOMENTS, or 10. */
int num_moments() {
  const char* text = std::getenv("NAO_FAULT_MOMENTS");
  return text != nullptr ? std::atoi(text) : 10;
}
/** Frames until the watchdog has taken over: after SIGKILL its pipe closes at once; after SIGSTOP
 * it waits 0.3 s; then it connects. */
constexpr int kFramesAfterKill = 9;
constexpr int kFramesAfterStop = 34;

enum class Fault { kMotion, kRobotKilled, kRobotStopped };

/** A robot that stands again after each fault. */
class RobotFaultTest : public testing::TestWithParam<Fault> {
 protected:
  /** The program dies. */
  void break_program() {
    switch (GetParam()) {
      case Fault::kMotion:
        loop_.has_motion = false;
        return;
      case Fault::kRobotKilled:
        return loop_.crash(kFramesAfterKill);
      case Fault::kRobotStopped:
        return loop_.crash(kFramesAfterStop);
    }
  }

  void recover() {
    if (GetParam() == Fault::kMotion) {
      loop_.has_motion = true;
    } else {
      loop_.restart();
    }
  }

  double random(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random_);
  }

  RobotLoop loop_;
  std::mt19937 random_{1};
};

TEST_P(RobotFaultTest, FromStandingItEndsSeatedEveryTime) {
  stand(loop_);
  for (int i = 0; i < num_moments(); ++i) {
    // This includes the middle of standing up, and the motion of the arms.
    loop_.run(random(0, 0.5));
    if (i % 2 == 1) {
      loop_.send(PostureCommand{i % 4 == 1 ? "Stand" : "StandInit", 0.5});
      loop_.run(random(0, 1));
    }
    break_program();
    ASSERT_TRUE(loop_.run_until([&] { return loop_.is_seated(); }, 5)) << i;
    recover();
    ASSERT_NO_FATAL_FAILURE(stand(loop_)) << i;
  }
  EXPECT_EQ(loop_.num_too_fast(), 0);
}

TEST_P(RobotFaultTest, LyingItIsLimpWithin100MsOfTheTakeOver) {
  stand(loop_);
  for (int i = 0; i < num_moments(); ++i) {
    loop_.place_lying();
    // From the first moment on the ground into the get-up motion, until it is upright again.
    loop_.run(random(0, 1));
    const bool is_tilted = loop_.tilt() > 0.6;
    break_program();
    // Ten lost commands are the take-over from motion.
    if (GetParam() == Fault::kMotion) loop_.run(0.12);
    if (is_tilted) {
      EXPECT_TRUE(loop_.run_until([&] { return loop_.is_limp(); }, 0.1)) << i;
    }
    loop_.run(0.5);
    recover();
    loop_.place("Crouch");
    ASSERT_NO_FATAL_FAILURE(stand(loop_)) << i;
  }
  EXPECT_EQ(loop_.num_too_fast(), 0);
}

TEST_P(RobotFaultTest, WalkingItEndsSeatedOrLyingButLimp) {
  int num_seated = 0;
  stand(loop_);
  for (int i = 0; i < num_moments(); ++i) {
    loop_.walk(0.12, 0.5);
    loop_.run(random(0, 0.5));
    break_program();
    loop_.run(5);
    EXPECT_TRUE(loop_.is_limp()) << i;
    num_seated += loop_.is_seated() ? 1 : 0;
    recover();
    loop_.place("Crouch");
    ASSERT_NO_FATAL_FAILURE(stand(loop_)) << i;
  }
  std::printf("seated: %d of %d\n", num_seated, num_moments());
  RecordProperty("seated", num_seated);
  EXPECT_GE(num_seated, num_moments() / 2);
  EXPECT_EQ(loop_.num_too_fast(), 0);
}

INSTANTIATE_TEST_SUITE_P(Programs, RobotFaultTest,
                         testing::Values(Fault::kMotion, Fault::kRobotKilled, Fault::kRobotStopped),
                         [](const auto& fault) {
                           return fault.param == Fault::kMotion        ? "MotionDies"
                                  : fault.param == Fault::kRobotKilled ? "RobotIsKilled"
                                                                       : "RobotHangs";
                         });

// The gateway is the source of the walk commands: without them the robot stops by itself.
TEST(GatewayFault, WithoutWalkCommandsItStandsStill) {
  RobotLoop loop;
  std::mt19937 random(2);
  stand(loop);
  for (int i = 0; i < num_moments(); ++i) {
    loop.walk(0.12, 0.5 + 0.5 * std::generate_canonical<double, 10>(random));
    loop.run(2.5);
    ASSERT_EQ(loop.core().safety().phase(), Phase::kDriven) << i;
    ASSERT_GT(loop.height(), 0.28) << i;
    ASSERT_LT(loop.tilt(), 0.3) << i;
  }
  EXPECT_EQ(loop.num_too_fast(), 0);
}

}  // namespace
}  // namespace nao::robot
