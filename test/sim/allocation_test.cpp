// A program of its own, since it counts all allocations of the process.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "common/random.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"

namespace {
std::atomic<long> num_allocations{0};
}

// glibc's malloc, which the definition below replaces.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* __libc_malloc(size_t size);
extern "C" void* malloc(size_t size) {
  ++num_allocations;
  return __libc_malloc(size);
}

namespace nao::sim {
namespace {

TEST(Allocation, IsCounted) {
  const long before = num_allocations;
  Eigen::VectorXd vector(1000);
  vector.setOnes();
  EXPECT_GT(num_allocations, before);
  EXPECT_EQ(vector.sum(), 1000);
}

TEST(Allocation, NoneInATick) {
  WorldOptions options;
  options.num_threads = 2;
  World world(SceneFile::find("soccer"), options);
  world.add_robot(nao_model());
  RobotOptions other;
  other.name = "OTHER";
  other.position = {0.3, 0};
  world.add_robot(nao_model(), other);
  Random random(4);
  MotorTargets targets = world.targets(0);
  const long before = num_allocations;
  for (int tick = 0; tick < 3000; ++tick) {
    for (int i = 0; i < nao_model()->num_motors(); ++i) {
      if (random.uniform() < 0.05) targets.position[i] = random.uniform(-1, 1);
    }
    world.set_targets(tick % 2, targets);
    if (tick % 300 == 0) world.place_ball({0.2, 0, 0}, {1, 0, 0});
    world.step_tick();
  }
  EXPECT_EQ(num_allocations, before);
}

}  // namespace
}  // namespace nao::sim
