// Measures the physics: CPU time of a step, in total, by stage, by number of contacts and of
// robots. Baseline, if installed: MuJoCo with the same robot, interleaved. Also measures the error
// of both at a time step of 2 ms relative to their own solution at 0.05 ms.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/processor_time.h"
#include "common/wall_clock.h"
#include "robot_model/robot_model.h"
#include "sim/world.h"
#include "tools/bench/physics_scenarios.h"
#include "tools/bench/run_benchmark.h"
#ifdef NAO_HAS_MUJOCO
#include "sim/mujoco_baseline.h"
#endif

namespace nao {
namespace {

using sim::MotorTargets;
using sim::RobotOptions;
using sim::World;
using sim::WorldOptions;

/** The project's physics in a scenario. */
class ProjectPhysics {
 public:
  ProjectPhysics(const PhysicsScenario& scenario, double step, const WorldOptions& base = {})
      : scenario_(scenario), options_(base) {
    options_.step = step;
    options_.steps_per_tick = static_cast<int>(std::lround(kControlPeriod / step));
    world_ = std::make_unique<World>(SceneFile{}, options_);
    RobotOptions robot;
    robot.posture = scenario.posture;
    robot.height = scenario.height;
    robot.command_latency_ticks = 0;
    world_->add_robot(nao_model(), robot);
    // The scenario's targets act on the robot from its first tick on.
    targets_ = world_->targets(0);
    if (scenario.is_limp) targets_.stiffness.setZero();
    world_->set_targets(0, targets_);
  }
  void tick() {
    if (tick_ < scenario_.targets.size()) {
      targets_.position = scenario_.targets[tick_];
      world_->set_targets(0, targets_);
    }
    ++tick_;
    world_->step_tick();
  }
  void restart() {
    world_->reset();
    if (scenario_.is_limp) world_->set_targets(0, targets_);
    tick_ = 0;
  }
  World& world() { return *world_; }
  const WorldOptions& options() const { return options_; }
  sim::TreeState state() const { return world_->robot(0).state(); }

 private:
  const PhysicsScenario& scenario_;
  WorldOptions options_;
  std::unique_ptr<World> world_;
  MotorTargets targets_;
  size_t tick_ = 0;
};

#ifdef NAO_HAS_MUJOCO
/** MuJoCo in the same scenario. */
class MujocoPhysics {
 public:
  MujocoPhysics(const PhysicsScenario& scenario, double step, sim::BaselineOptions options = {})
      : scenario_(scenario),
        start_(scenario, step),
        steps_per_tick_(start_.options().steps_per_tick),
        state_(start_.state()),
        baseline_(start_.world().robot(0), start_.options(),
                  {options.feet, options.laws, scenario.is_limp}) {}
  void tick() {
    if (tick_ < scenario_.targets.size()) baseline_.set_targets(scenario_.targets[tick_]);
    ++tick_;
    for (int i = 0; i < steps_per_tick_; ++i) baseline_.step();
  }
  void restart() {
    baseline_.set_state(start_.world().robot(0).tree(), state_);
    baseline_.set_targets(start_.world().robot(0).motor_position());
    tick_ = 0;
  }
  sim::TreeState state() { return baseline_.state(start_.world().robot(0).tree()); }
  int num_contacts() { return baseline_.data().ncon; }

 private:
  const PhysicsScenario& scenario_;
  ProjectPhysics start_;
  int steps_per_tick_;
  sim::TreeState state_;
  sim::MujocoBaseline baseline_;
  size_t tick_ = 0;
};
#endif

/** Root mean square difference of all joint angles, rad. */
double joint_difference(const sim::TreeState& a, const sim::TreeState& b) {
  const Eigen::VectorXd difference = a.coordinate - b.coordinate;
  // The first six coordinates are unused (TreeState).
  return std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size() - 6));
}

/** RMS joint angle error of one simulation relative to another over a duration, rad. */
template <class Physics, class Reference>
double difference(Physics& physics, Reference& reference, int ticks) {
  double sum = 0;
  for (int i = 0; i < ticks; ++i) {
    physics.tick();
    reference.tick();
    // Sum of squares over ticks; the root is taken of their mean.
    sum += std::pow(joint_difference(physics.state(), reference.state()), 2);
  }
  return std::sqrt(sum / ticks);
}

// Time steps, s: that of nao-sim, and a fortieth of it as the reference.
constexpr double kStep = 0.002;
constexpr double kFineStep = 0.00005;

/** RMS joint angle error at a time step of 2 ms relative to the same physics at 0.05 ms, rad. */
template <class Physics>
double step_error(const PhysicsScenario& scenario, int ticks) {
  Physics coarse(scenario, kStep);
  Physics fine(scenario, kFineStep);
  return difference(coarse, fine, ticks);
}

#ifdef NAO_HAS_MUJOCO
/** RMS joint angle error at a time step of 2 ms relative to a common reference solution, rad:
 * MuJoCo at 0.05 ms with the project's contact and friction models. */
template <class Physics>
double common_error(const PhysicsScenario& scenario, int ticks) {
  Physics coarse(scenario, kStep);
  MujocoPhysics reference(scenario, kFineStep,
                          {sim::BaselineFeet::kPoints, sim::BaselineLaws::kMatched});
  return difference(coarse, reference, ticks);
}
#endif

/** CPU time of a step of several interleaved tasks, us. */
std::vector<double> times_in_turns(const std::vector<std::function<void()>>& ticks, int rounds,
                                   int ticks_per_round, int steps_per_tick) {
  // The tasks are interleaved, so that other load on the machine affects all equally; the median of
  // the rounds ignores single disturbances.
  std::vector<std::vector<double>> times(ticks.size());
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < ticks.size(); ++i) {
      const double start = thread_seconds();
      for (int k = 0; k < ticks_per_round; ++k) ticks[i]();
      times[i].push_back(1e6 * (thread_seconds() - start) / (ticks_per_round * steps_per_tick));
    }
  }
  std::vector<double> medians;
  for (const std::vector<double>& each : times) medians.push_back(median(each));
  return medians;
}

void measure_scenario(const PhysicsScenario& scenario, int rounds, std::vector<Figure>& figures) {
  // A recorded motion restarts in each round; a resting state first settles.
  const bool is_recorded = !scenario.targets.empty();
  const int ticks = is_recorded ? static_cast<int>(scenario.targets.size()) : 100;
  ProjectPhysics ours(scenario, 0.002);
  // A robot that was placed settles on the floor first.
  for (int i = 0; i < 300 && !is_recorded; ++i) ours.tick();
  std::vector<std::function<void()>> tasks;
  int tick_of_ours = 0;
  double contacts = 0;
  double iterations = 0;
  int64_t counted = 0;
  tasks.emplace_back([&] {
    if (is_recorded && tick_of_ours++ % ticks == 0) ours.restart();
    ours.tick();
    contacts += static_cast<double>(ours.world().contacts().size());
    iterations += ours.world().last_iterations();
    ++counted;
  });
#ifdef NAO_HAS_MUJOCO
  MujocoPhysics points(scenario, 0.002);
  MujocoPhysics boxes(scenario, 0.002, {sim::BaselineFeet::kBoxes});
  for (int i = 0; i < 300 && !is_recorded; ++i) {
    points.tick();
    boxes.tick();
  }
  std::array<int, 2> tick_of_theirs{0, 0};
  double their_contacts = 0;
  tasks.emplace_back([&] {
    if (is_recorded && tick_of_theirs[0]++ % ticks == 0) points.restart();
    points.tick();
    their_contacts += points.num_contacts();
  });
  tasks.emplace_back([&] {
    if (is_recorded && tick_of_theirs[1]++ % ticks == 0) boxes.restart();
    boxes.tick();
  });
#endif
  const std::vector<double> us = times_in_turns(tasks, rounds, ticks, 5);
  const std::string name = "physics." + scenario.name;
  std::fprintf(stderr, "%s: %.1f contacts, %.1f solver iterations per step", name.c_str(),
               contacts / static_cast<double>(counted), iterations / static_cast<double>(counted));
#ifdef NAO_HAS_MUJOCO
  const sim::TreeState end_ours = ours.state();
  const sim::TreeState end_theirs = points.state();
  std::fprintf(
      stderr,
      "; MuJoCo %.1f contacts; torso at the end (%.2f, %.2f, %.2f), MuJoCo (%.2f, %.2f, %.2f)",
      their_contacts / static_cast<double>(counted), end_ours.position.x(), end_ours.position.y(),
      end_ours.position.z(), end_theirs.position.x(), end_theirs.position.y(),
      end_theirs.position.z());
  figures.push_back({name + ".speedup", us[1] / us[0], "x", "MuJoCo, same contact points", 1});
  figures.push_back(
      {name + ".speedup_over_box_feet", us[2] / us[0], "x", "MuJoCo, feet as boxes", 1});
  figures.push_back({name + ".step_us", us[0], "us", "MuJoCo, same contact points", us[1]});
#else
  figures.push_back({name + ".step_us", us[0], "us", "", 0});
#endif
  std::fprintf(stderr, "\n");
  figures.push_back({name + ".contacts", contacts / static_cast<double>(counted), "", "", 0});
}

struct StageTimes {
  double last = 0;
  std::array<double, 5> sum{};
};

void measure_stages(const PhysicsScenario& scenario, std::vector<Figure>& figures) {
  static constexpr const char* kNames[] = {"dynamics", "collision", "rows", "solve", "integrate"};
  ProjectPhysics ours(scenario, 0.002);
  StageTimes times;
  for (int i = 0; i < 300; ++i) ours.tick();
  // The probe is called once after each stage.
  // Reading the clock takes about as long as a stage: the duration of the readings is subtracted.
  constexpr int kReadings = 100000;
  const double start = thread_seconds();
  for (int i = 0; i < kReadings; ++i) (void)thread_seconds();
  const double reading = (thread_seconds() - start) / kReadings;
  ours.world().set_stage_probe(
      [](World::Stage stage, void* user) {
        auto& all = *static_cast<StageTimes*>(user);
        const double now = thread_seconds();
        all.sum[static_cast<size_t>(stage)] += now - all.last;
        all.last = now;
      },
      &times);
  constexpr int kSteps = 20000;  // 40 s of simulated time
  for (int i = 0; i < kSteps; ++i) {
    times.last = thread_seconds();
    ours.world().step();
  }
  for (size_t i = 0; i < times.sum.size(); ++i) {
    figures.push_back({"physics." + scenario.name + ".stage_" + kNames[i] + "_us",
                       1e6 * (times.sum[i] / kSteps - reading), "us", "", 0});
  }
}

void measure_contacts(const PhysicsScenario& standing, std::vector<Figure>& figures) {
  std::vector<std::unique_ptr<ProjectPhysics>> all;
  std::vector<std::function<void()>> tasks;
  const std::vector<int> corners{3, 4, 6, 8, 12, 15};
  for (const int count : corners) {
    WorldOptions options;
    options.num_sole_points = count;
    all.push_back(std::make_unique<ProjectPhysics>(standing, 0.002, options));
    for (int i = 0; i < 300; ++i) all.back()->tick();
    tasks.emplace_back([&ours = *all.back()] { ours.tick(); });
  }
  const std::vector<double> us = times_in_turns(tasks, 21, 50, 5);
  for (size_t i = 0; i < corners.size(); ++i) {
    figures.push_back(
        {"physics.contacts_" + std::to_string(2 * corners[i]) + ".step_us", us[i], "us", "", 0});
  }
}

void measure_robots(std::vector<Figure>& figures) {
  std::vector<std::unique_ptr<World>> all;
  std::vector<std::function<void()>> tasks;
  const std::vector<int> counts{1, 2, 4, 8};
  for (const int count : counts) {
    all.push_back(std::make_unique<World>(SceneFile::find("soccer")));
    for (int i = 0; i < count; ++i) {
      RobotOptions robot;
      robot.name = "R" + std::to_string(i);
      const int row = i / 2;
      // In two rows, far enough apart not to touch.
      robot.position = {-2.0 + row, i % 2 == 0 ? -1 : 1};
      all.back()->add_robot(nao_model(), robot);
    }
    for (int i = 0; i < 200; ++i) all.back()->step_tick();
    tasks.emplace_back([&world = *all.back()] { world.step_tick(); });
  }
  const std::vector<double> us = times_in_turns(tasks, 21, 20, 5);
  for (size_t i = 0; i < counts.size(); ++i) {
    figures.push_back(
        {"physics.robots_" + std::to_string(counts[i]) + ".step_us", us[i], "us", "", 0});
  }
}

/** Two standing robots far from each other, and the ball: wall time of a tick with one thread over
 * that with two. Meaningful on two idle cores only. */
void measure_threads(std::vector<Figure>& figures) {
  std::vector<std::unique_ptr<World>> all;
  for (const int num_threads : {1, 2}) {
    WorldOptions options;
    options.num_threads = num_threads;
    all.push_back(std::make_unique<World>(SceneFile::find("soccer"), options));
    for (int i = 0; i < 2; ++i) {
      RobotOptions robot;
      robot.name = "R" + std::to_string(i);
      robot.position = {-2, i == 0 ? -1 : 1};
      all.back()->add_robot(nao_model(), robot);
    }
    for (int i = 0; i < 200; ++i) all.back()->step_tick();
  }
  std::array<std::vector<double>, 2> times;
  for (int round = 0; round < 41; ++round) {
    for (size_t i = 0; i < all.size(); ++i) {
      const double start = monotonic_seconds();
      for (int tick = 0; tick < 20; ++tick) all[i]->step_tick();
      times[i].push_back(monotonic_seconds() - start);
    }
  }
  const double one = median(times[0]);
  const double two = median(times[1]);
  figures.push_back({"physics.threads_2_speedup", one / two, "x", "one thread", 1});
}

std::vector<Figure> measure(int rounds) {
  std::vector<Figure> figures;
  PhysicsScenario standing;
  standing.name = "standing";
  PhysicsScenario lying;
  lying.name = "lying";
  for (const Posture& posture : nao_model()->postures()) {
    if (posture.family == "lying-back") lying.posture = posture.name;
  }
  lying.is_limp = true;
  const PhysicsScenario walk = walking();
  const PhysicsScenario fall = falling();

  measure_scenario(standing, rounds, figures);
  const auto standing_us = std::find_if(figures.begin(), figures.end(), [](const Figure& figure) {
    return figure.name == "physics.standing.step_us";
  });
  const double step_us = standing_us->value;
  measure_scenario(walk, std::max(3, rounds / 10), figures);
  measure_scenario(lying, rounds, figures);
  figures.push_back({"physics.step_us", step_us, "us", "", 0});
  // A step is 2000 us of simulated time.
  figures.push_back({"physics.real_time_factor", 2000 / step_us, "", "", 0});
  measure_stages(standing, figures);
  measure_contacts(standing, figures);
  measure_robots(figures);
  measure_threads(figures);

  for (const PhysicsScenario* scenario :
       std::vector<const PhysicsScenario*>{&fall, &standing, &walk, &lying}) {
    const int ticks = scenario == &walk ? 250 : 100;
    Figure figure{"physics." + scenario->name + ".error_mrad",
                  1e3 * step_error<ProjectPhysics>(*scenario, ticks), "mrad", "", 0};
#ifdef NAO_HAS_MUJOCO
    figure.baseline = "MuJoCo, same contact points";
    figure.baseline_value = 1e3 * step_error<MujocoPhysics>(*scenario, ticks);
#endif
    figures.push_back(figure);
#ifdef NAO_HAS_MUJOCO
    figures.push_back({"physics." + scenario->name + ".common_error_mrad",
                       1e3 * common_error<ProjectPhysics>(*scenario, ticks), "mrad",
                       "MuJoCo, same contact points",
                       1e3 * common_error<MujocoPhysics>(*scenario, ticks)});
#endif
  }
  return figures;
}

}  // namespace
}  // namespace nao

int main(int argc, char** argv) {
  nao::CommandLine app("Measures the physics. Baseline, if installed: MuJoCo.",
                       "nao-bench-physics");
  int rounds = 40;
  app.add_option("--rounds", rounds, "Repetitions of each simulator in each scenario")
      ->range(3, 1000);
  return nao::run_benchmark(app, argc, argv, [&] { return nao::measure(rounds); });
}
