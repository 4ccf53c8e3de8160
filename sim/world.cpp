#include "sim/world.h"

#include <algorithm>
#include <string>
#include <utility>

#include "common/error.h"

namespace nao::sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

void check(bool is_valid, const std::string& name, double value, const std::string& range) {
  if (is_valid) return;
  throw ConfigError(name + " is " + std::to_string(value) + " and must be " + range);
}

WorldOptions checked(const WorldOptions& options) {
  check(options.step > 0, "physics step", options.step, "above 0 s");
  check(options.steps_per_tick >= 1, "steps per tick", options.steps_per_tick, "1 or more");
  check(options.num_threads >= 1 && options.num_threads <= 64, "number of threads",
        options.num_threads, "1 to 64");
  check(options.num_sole_points >= 3, "number of sole points", options.num_sole_points,
        "3 or more");
  check(options.floor.bump_height >= 0, "height of bumps", options.floor.bump_height,
        "0 m or more");
  check(options.floor.bump_grid > 0, "distance of bumps", options.floor.bump_grid, "above 0 m");
  return options;
}

void check(const RobotOptions& options) {
  check(options.command_latency_ticks >= 0 &&
            options.command_latency_ticks <= kMaxCommandLatencyTicks,
        "command latency", options.command_latency_ticks, "0 to 10 ticks");
  check(options.mass_scale > 0, "mass scale", options.mass_scale, "above 0");
  check(options.torque_scale > 0, "torque scale", options.torque_scale, "above 0");
  check(options.friction_scale > 0, "friction scale", options.friction_scale, "above 0");
}

MovingBodies bodies_of(const SceneFile& scene) {
  MovingBodies bodies;
  if (scene.ball) bodies.ball.emplace(*scene.ball);
  return bodies;
}

}  // namespace

World::World(const SceneFile& scene, const WorldOptions& options)
    : scene_(scene),
      options_(checked(options)),
      materials_(options_.materials),
      floor_(options.floor),
      bodies_(bodies_of(scene)),
      engine_(make_engine(scene_, options_, bodies_)) {
  reset();
}

int World::add_robot(std::shared_ptr<const RobotModel> model, const RobotOptions& options) {
  check(options);
  // The springs of all contacts are those for the heaviest robot.
  max_mass_ = std::max(max_mass_, model->total_mass());
  options_.materials = materials_;
  options_.materials.bear(max_mass_);
  bodies_.robots.push_back(std::make_unique<SimRobot>(std::move(model), options, options_));
  bodies_.robots.back()->set_tick(tick_, options_.period());
  engine_->add_robot();
  return num_robots() - 1;
}

void World::remove_robot(int robot) {
  bodies_.robots.erase(bodies_.robots.begin() + robot);
  engine_->remove_robot(robot);
}

double World::time() const {
  // Product instead of a running sum: no rounding error grows with time.
  return static_cast<double>(engine_->num_steps()) * options_.step;
}

const BallState& World::ball() const {
  static const BallState no_ball;
  return bodies_.ball ? bodies_.ball->state() : no_ball;
}

void World::set_targets(int robot, const MotorTargets& targets) {
  bodies_.robots[robot]->set_targets(targets);
}

void World::step() {
  engine_->step();
}

void World::step_tick() {
  // Motors get new targets and sensors are read once a control period; the physics takes several
  // steps in between.
  engine_->step_tick();
  ++tick_;
  check_states();
}

void World::check_states() {
  for (int i = 0; i < num_robots(); ++i) {
    // A diverged state would spread through contacts to other bodies. Its robot restarts, and the
    // others continue.
    if (robot(i).is_within_bounds()) continue;
    ++num_bad_states_;
    return_to_start(i);
    bodies_.robots[i]->end_tick(options_.period());
  }
  if (bodies_.ball && !bodies_.ball->is_within_bounds()) {
    ++num_bad_states_;
    return_ball_to_start();
    engine_->forget_contacts_of_ball();
  }
}

void World::return_to_start(int robot) {
  // Impulses that are kept for a warm start belong to contacts of the old pose: in the new one they
  // would push.
  bodies_.robots[robot]->return_to_start();
  engine_->forget_contacts_of_robot(robot);
}

void World::reset() {
  tick_ = 0;
  num_bad_states_ = 0;
  for (int i = 0; i < num_robots(); ++i) {
    return_to_start(i);
    bodies_.robots[i]->switch_on();
  }
  if (bodies_.ball) return_ball_to_start();
  engine_->reset();
}

void World::return_ball_to_start() {
  bodies_.ball->reset();
  const Vector3d& at = bodies_.ball->state().position;
  if (!floor_.is_flat()) place_ball({at.x(), at.y(), 0}, Vector3d::Zero());
}

void World::place_robot(int index, const Posture* posture, const Vector3d& position,
                        const Quaterniond* orientation) {
  bodies_.robots[index]->place(posture, position, orientation);
  engine_->forget_contacts_of_robot(index);
}

void World::place_ball(const Vector3d& position, const Vector3d& velocity) {
  if (!bodies_.ball) return;
  const double ground = floor_.at(position.x(), position.y()).height;
  bodies_.ball->place(position + Vector3d(0, 0, ground), velocity);
  engine_->forget_contacts_of_ball();
}

void World::push(int robot, int link, const Vector3d& impulse) {
  bodies_.robots[robot]->push(link, impulse);
}

void World::drag(int robot, const LinkDrag& drag) {
  bodies_.robots[robot]->drag(drag);
}

void World::push_ball(const Vector3d& impulse) {
  if (bodies_.ball) bodies_.ball->push(impulse);
}

double World::energy() const {
  // Kinetic and potential energy, and that stored in compliant contacts.
  double sum = engine_->elastic_energy();
  for (const auto& robot : bodies_.robots) sum += robot->energy();
  if (bodies_.ball) sum += bodies_.ball->energy(options_.gravity);
  return sum;
}

}  // namespace nao::sim
