#include "test/daemons/robot/robot_loop.h"

#include <gtest/gtest.h>

namespace nao::robot {
namespace {

TEST(RobotLoop, SitsDownGetsStiffAndStandsUp) {
  RobotLoop loop;
  loop.run(0.1);
  EXPECT_EQ(loop.core().safety().phase(), Phase::kSitting) << "the simulated servos start stiff";
  EXPECT_TRUE(loop.run_until([&] { return loop.core().safety().phase() == Phase::kLimp; }, 4));
  EXPECT_LT(loop.tilt(), 0.2);
  stand(loop);
  EXPECT_LT(loop.tilt(), 0.2);
}

TEST(RobotLoop, ReachesPosturesAndWalks) {
  RobotLoop loop;
  stand(loop);
  loop.send(PostureCommand{"Crouch", 0.5});
  EXPECT_TRUE(loop.run_until([&] { return loop.last_status() == ResultStatus::kDone; }, 15));
  EXPECT_LT(loop.height(), 0.26);
  loop.send(PostureCommand{"StandInit", 0.5});
  loop.run(0.1);
  EXPECT_TRUE(loop.run_until([&] { return loop.last_status() == ResultStatus::kDone; }, 15));
  const Eigen::Vector3d start = loop.position();
  loop.walk(0.1, 6);
  loop.run(3);
  EXPECT_GT((loop.position() - start).head<2>().norm(), 0.3);
  EXPECT_LT(loop.tilt(), 0.2);
}

TEST(RobotLoop, EndsSeatedWheneverItsControllerOrItsProgramDiesWhileItStands) {
  RobotLoop loop;
  stand(loop);
  for (int i = 0; i < 5; ++i) {
    loop.has_motion = false;
    EXPECT_TRUE(loop.run_until([&] { return loop.is_seated(); }, 4)) << i;
    loop.has_motion = true;
    stand(loop);
    loop.run(0.1 * i);
  }
  loop.crash(20);
  EXPECT_TRUE(loop.run_until([&] { return loop.is_seated(); }, 4));
  // The program ends after the frame that shows it.
  loop.frame();
  EXPECT_EQ(loop.core().safety().phase(), Phase::kEnded);
}

TEST(RobotLoop, LyingItIsLimpWithin100MsOfACrash) {
  RobotLoop loop;
  stand(loop);
  loop.place_lying();
  loop.run(0.5);
  EXPECT_FALSE(loop.is_limp());
  loop.crash(0);
  EXPECT_TRUE(loop.run_until([&] { return loop.is_limp(); }, 0.1));
}

TEST(RobotLoop, WhileItWalksItEndsSeatedOrLyingButLimp) {
  int num_seated = 0;
  for (int i = 0; i < 4; ++i) {
    RobotLoop loop(static_cast<uint64_t>(i + 1));
    stand(loop);
    loop.walk(0.12, 1.5 + 0.13 * i);
    if (i % 2 == 0) {
      loop.has_motion = false;
    } else {
      loop.crash(25);
    }
    loop.run(5);
    EXPECT_TRUE(loop.is_limp()) << i;
    num_seated += loop.is_seated() ? 1 : 0;
  }
  RecordProperty("seated_of_4", num_seated);
  EXPECT_GE(num_seated, 2);
}

}  // namespace
}  // namespace nao::robot
