#include "tools/bench/physics_scenarios.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "sim/closed_loop/closed_loop.h"

namespace nao {

std::shared_ptr<const RobotModel> nao_model() {
  static const auto model = std::make_shared<const RobotModel>(RobotModel::find("nao"));
  return model;
}

PhysicsScenario walking() {
  PhysicsScenario scenario;
  scenario.name = "walking";
  ClosedLoopOptions options;
  options.model = nao_model();
  options.is_ideal = true;
  ClosedLoop trial(options, 1);
  trial.on_tick([&] {
    const std::vector<double>& targets = trial.targets();
    scenario.targets.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(targets.data(), static_cast<long>(targets.size())));
  });
  trial.run(1);
  trial.hold_walk({0.1, 0, 0});
  trial.run(9);
  std::fprintf(stderr, "physics: recorded a walk of %.2f m\n",
               trial.torso_in_world().translation().x());
  return scenario;
}

PhysicsScenario falling() {
  PhysicsScenario scenario;
  scenario.name = "falling";
  scenario.height = 10;
  const Posture& start = nao_model()->ready_posture();
  // The second joints of the legs, which spread them: the feet do not touch each other.
  const auto& legs = nao_model()->legs();
  const std::array<int, 2> hip_rolls = {nao_model()->motor_of(legs[0].joints[1]),
                                        nao_model()->motor_of(legs[1].joints[1])};
  for (int tick = 0; tick < 100; ++tick) {
    Eigen::VectorXd targets(nao_model()->num_motors());
    for (int i = 0; i < targets.size(); ++i) {
      targets[i] = start.position[static_cast<size_t>(i)] +
                   0.3 * std::sin(kControlPeriod * tick * (3 + 0.3 * i));
    }
    for (const int motor : hip_rolls) {
      targets[motor] += motor == hip_rolls.front() ? 0.25 : -0.25;
    }
    scenario.targets.push_back(targets);
  }
  return scenario;
}

}  // namespace nao
