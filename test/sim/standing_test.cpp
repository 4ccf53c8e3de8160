#include <gtest/gtest.h>

#include "sim/world.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

double floor_force(const World& world) {
  double sum = 0;
  for (const Contact& contact : world.contacts()) {
    if (contact.b.kind == Surface::Kind::kFloor) sum += contact.force_on_a.z();
  }
  return sum;
}

class Standing : public testing::TestWithParam<const char*> {};

TEST_P(Standing, CarriesTheWeightAndStaysInPlace) {
  World world{SceneFile{}};
  RobotOptions options;
  options.posture = GetParam();
  const int robot = world.add_robot(nao_model(), options);
  for (int i = 0; i < 200; ++i) world.step_tick();
  const Eigen::Vector3d settled = world.robot(robot).state().position;
  for (int i = 0; i < 1000; ++i) world.step_tick();
  const double weight = world.options().gravity.norm() * world.robot(robot).tree().total_mass();
  EXPECT_NEAR(floor_force(world) / weight, 1, 1e-6);
  EXPECT_LT((world.robot(robot).state().position - settled).norm(), 1e-5);
  EXPECT_NEAR(world.sensors(robot).foot_force.sum() / weight, 1, 0.05);
  EXPECT_NEAR(world.time(), 12, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Postures, Standing,
                         testing::Values("StandInit", "StandZero", "Stand", "Crouch"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace nao::sim
