#include "daemons/play/autonomy.h"

#include <gtest/gtest.h>

namespace nao::play {
namespace {

const AutonomyInput kReady{true, true, false, false};
const AutonomyInput kPlaying{true, true, true, true};

TEST(Autonomy, BeginsWithANewCommandAndRepeatsIt) {
  Autonomy autonomy(true, 100);
  EXPECT_EQ(autonomy.step(kReady, 0), 101);
  EXPECT_EQ(autonomy.step(kPlaying, 0.4), std::nullopt);
  EXPECT_EQ(autonomy.step(kPlaying, 0.5), 101);
  EXPECT_EQ(autonomy.step(kReady, 1.0), 102) << "the behavior has ended";
}

TEST(Autonomy, WaitsForAMatchAndForTheRobot) {
  Autonomy autonomy(true, 0);
  EXPECT_EQ(autonomy.step({false, true, false, false}, 0), std::nullopt);
  EXPECT_EQ(autonomy.step({true, false, false, false}, 1), std::nullopt);
  EXPECT_EQ(autonomy.step(kReady, 2), 1);
}

TEST(Autonomy, LeavesAnothersBehaviorAlone) {
  Autonomy autonomy(true, 0);
  EXPECT_EQ(autonomy.step({true, true, true, false}, 0), std::nullopt);
}

TEST(Autonomy, WaitsForReleaseAfterAnothersCommandInAMatch) {
  Autonomy autonomy(true, 0);
  EXPECT_EQ(autonomy.step(kReady, 0), 1);
  autonomy.note_other_command(1);
  EXPECT_TRUE(autonomy.waits_for_release());
  EXPECT_EQ(autonomy.step(kReady, 3600), std::nullopt);
  autonomy.release();
  EXPECT_EQ(autonomy.step(kReady, 3601), 2);
}

TEST(Autonomy, WaitsTenSecondsAfterACommandBeforeTheMatch) {
  Autonomy autonomy(true, 0);
  autonomy.note_other_command(0);
  EXPECT_FALSE(autonomy.waits_for_release());
  EXPECT_EQ(autonomy.step(kReady, 9.9), std::nullopt);
  EXPECT_EQ(autonomy.step(kReady, 10), 1);
}

TEST(Autonomy, IsOffUnlessEnabled) {
  Autonomy autonomy(false, 0);
  EXPECT_EQ(autonomy.step(kReady, 0), std::nullopt);
}

}  // namespace
}  // namespace nao::play
