// Random targets and stiffness, pushes, placements and balls. The environment variable
// NAO_SHAKE_STEPS sets the number of steps, 1e7 for example.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/random.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

/** Depths of the robot's parts in the floor. */
struct Depth {
  /** Depth of the deepest point, m. */
  double greatest = 0;
  /** Height of the lowest center of a part, m: below 0 it has gone through. */
  double lowest_center = 1;

  void add(const SimRobot& robot) {
    for (const CollisionModel::Part& part : robot.collisions().parts) {
      double height_sum = 0;
      for (int i = part.first_point; i < part.end_point; ++i) {
        const CollisionModel::Point& point = robot.collisions().points[i];
        const Vector3d in_world = robot.dynamics().position(part.body) +
                                  robot.dynamics().rotation(part.body) * point.center_in_body;
        greatest = std::max(greatest, point.radius - in_world.z());
        height_sum += in_world.z();
      }
      // The center of a box, a capsule or a sphere is the mean of its points.
      const int num_points = part.end_point - part.first_point;
      if (num_points > 0) lowest_center = std::min(lowest_center, height_sum / num_points);
    }
  }
};

TEST(Shake, LeavesNoBadStateAndNothingFallsThroughTheFloor) {
  const char* num_steps = std::getenv("NAO_SHAKE_STEPS");
  const long num_ticks = (num_steps != nullptr ? std::atol(num_steps) : 100000) / 5;
  const RobotModel& model = *nao_model();
  World world(SceneFile::find("soccer"));
  world.add_robot(nao_model());
  Random random(1);
  const auto direction = [&random] {
    return Vector3d(random.normal(), random.normal(), random.normal());
  };
  MotorTargets targets = world.targets(0);
  // This is checked in every step: a part that goes through the floor may return within a tick.
  struct Probe {
    const World& world;
    Depth depth;
  } probe{world, {}};
  world.set_stage_probe(
      [](World::Stage stage, void* user) {
        auto& it = *static_cast<Probe*>(user);
        if (stage == World::Stage::kIntegrate) it.depth.add(it.world.robot(0));
      },
      &probe);
  double fastest = 0;
  double largest_energy = 0;
  for (long tick = 0; tick < num_ticks; ++tick) {
    if (random.uniform() < 0.1) {
      for (int i = 0; i < model.num_motors(); ++i) {
        if (random.uniform() > 0.3) continue;
        const Joint& joint = model.motor_joint(i);
        targets.position[i] = random.uniform(joint.lower, joint.upper);
        targets.stiffness[i] = random.uniform() < 0.2 ? 0 : random.uniform();
      }
    }
    if (random.uniform() < 0.01) {
      const int link = static_cast<int>(random.next() % model.links().size());
      world.push(0, link, 2 * direction());
    }
    if (random.uniform() < 0.002) {
      const Vector3d at = world.robot(0).state().position;
      world.place_ball({at.x() + 0.3, at.y(), 0}, 3 * direction().cwiseProduct(Vector3d(1, 1, 0)));
    }
    if (random.uniform() < 0.0005) {
      const size_t index = random.next() % model.postures().size();
      world.place_robot(0, &model.postures()[index],
                        {random.uniform(-4, 4), random.uniform(-3, 3), random.uniform(0, 0.5)});
      targets = world.targets(0);
    }
    if (random.uniform() < 0.0001) {
      world.reset();
      targets = world.targets(0);
    }
    world.set_targets(0, targets);
    world.step_tick();
    ASSERT_EQ(world.num_bad_states(), 0) << "tick " << tick;
    const SimRobot& robot = world.robot(0);
    ASSERT_TRUE(robot.state().velocity.allFinite() && robot.state().position.allFinite());
    fastest = std::max(fastest, robot.state().velocity.cwiseAbs().maxCoeff());
    largest_energy = std::max(largest_energy, world.energy());
  }
  EXPECT_GT(probe.depth.lowest_center, 0);
  EXPECT_LT(probe.depth.greatest, 0.025);
  EXPECT_LT(fastest, 250);
  EXPECT_LT(largest_energy, 200);
  std::printf(
      "%ld steps: deepest point %.1f mm, lowest center of a part %.1f mm above the floor, fastest "
      "coordinate %.0f /s, largest energy %.0f J\n",
      5 * num_ticks, 1e3 * probe.depth.greatest, 1e3 * probe.depth.lowest_center, fastest,
      largest_energy);
}

}  // namespace
}  // namespace nao::sim
