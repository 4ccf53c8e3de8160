#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "sim/closed_loop/closed_loop.h"

namespace nao::trial {
namespace {

ClosedLoop make_trial(uint64_t seed) {
  const std::filesystem::path data = NAO_TEST_DATA;
  static const auto model =
      std::make_shared<const RobotModel>(RobotModel::load(data / "robots" / "nao"));
  ClosedLoopOptions options;
  options.model = model;
  options.scene = SceneFile::load(data / "scenes" / "empty.yaml");
  return ClosedLoop(options, seed);
}

double sole_distance(ClosedLoop& trial) {
  const auto sole = [&](int link) {
    return Eigen::Vector3d(trial.world().robot(0).link_pose(link).translation());
  };
  return (sole(trial.model().left_sole()) - sole(trial.model().right_sole())).norm();
}

TEST(Block, StandsWideAndLowAndComesBack) {
  ClosedLoop trial = make_trial(1);
  trial.run(1);
  const double narrow = sole_distance(trial);
  const int64_t id = trial.send_action("block");
  trial.run(1);
  EXPECT_GT(sole_distance(trial), 1.5 * narrow);
  EXPECT_LT(trial.torso_height(), 0.28);
  EXPECT_LT(trial.torso_tilt(), 0.3);
  const auto end = trial.await_end(id, 20);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
  EXPECT_GT(trial.torso_height(), 0.3);
}

TEST(Dive, ThrowsItselfToItsSideAndSaysDoneWhenItStandsAgain) {
  for (const bool is_left : {true, false}) {
    ClosedLoop trial = make_trial(2);
    trial.run(1);
    const int64_t id = trial.send_action(is_left ? "dive-left" : "dive-right");
    ASSERT_TRUE(trial.run_until([&] { return trial.torso_tilt() > 1.2; }, 1));
    // Up, seen from a torso that lies on its left, is to its right.
    const double up = trial.torso_in_world().linear()(2, 1);
    EXPECT_LT((is_left ? 1 : -1) * up, -0.5);
    const auto end = trial.await_end(id, 60);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->status, ResultStatus::kDone) << end->reason;
    EXPECT_LT(trial.torso_tilt(), 0.3);
    EXPECT_GT(trial.torso_height(), 0.28);
  }
}

TEST(Keeper, RefusesWhatSoftLegsCannotDo) {
  ClosedLoop trial = make_trial(3);
  trial.run(1);
  ASSERT_TRUE(trial.await_end(trial.send_action("rest"), 20));
  for (const char* action : {"block", "dive-left", "kick-left"}) {
    const auto end = trial.await_end(trial.send_action(action), 1);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->status, ResultStatus::kRefused);
    EXPECT_EQ(end->reason.code, "legs-too-soft") << end->reason;
  }
  trial.hold_walk({0.1, 0, 0});
  trial.run(0.1);
  EXPECT_EQ(trial.results().back().status, ResultStatus::kRefused);
}

}  // namespace
}  // namespace nao::trial
