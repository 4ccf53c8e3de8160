// The walk in another physics: built only where MuJoCo is installed.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include "sim/closed_loop/closed_loop.h"
#include "sim/mujoco_baseline.h"

namespace nao::trial {
namespace {

TEST(WalkReplay, TheSameTargetsLeadAsFarInMujoco) {
  ClosedLoopOptions options;
  options.model = std::make_shared<const RobotModel>(
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao"));
  options.is_ideal = true;
  ClosedLoop trial(options, 1);
  std::vector<Eigen::VectorXd> targets;
  trial.on_tick([&] {
    targets.emplace_back(
        Eigen::VectorXd::Map(trial.targets().data(), static_cast<long>(trial.targets().size())));
  });
  const double start = trial.torso_in_world().translation().x();
  trial.run(1);
  trial.hold_walk({0.1, 0, 0});
  trial.run(9);
  const double way = trial.torso_in_world().translation().x() - start;
  EXPECT_GT(way, 0.6);

  // The run is open loop: deviations are not corrected.
  sim::WorldOptions world_options;
  sim::World world(SceneFile{}, world_options);
  sim::RobotOptions robot;
  robot.command_latency_ticks = 0;
  world.add_robot(options.model, robot);
  const sim::Tree& tree = world.robot(0).tree();
  sim::MujocoBaseline baseline(world.robot(0), world_options);
  baseline.set_state(tree, world.robot(0).state());
  const double baseline_start = world.robot(0).state().position.x();
  for (const Eigen::VectorXd& target : targets) {
    baseline.set_targets(target);
    for (int i = 0; i < world_options.steps_per_tick; ++i) baseline.step();
  }
  const sim::TreeState end = baseline.state(tree);
  EXPECT_NEAR(end.position.x() - baseline_start, way, 0.1 * way);
  EXPECT_GT(end.position.z(), 0.28);
}

}  // namespace
}  // namespace nao::trial
