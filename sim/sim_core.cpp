#include "sim/sim_core.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/data_path.h"
#include "common/error.h"
#include "robot_model/robot_lights.h"
#include "sim/disturbance_draw.h"
#include "sim/start_places.h"

namespace nao::sim {
namespace {

/** World commands that are remembered, to ignore repetitions. Chosen: far more than are repeated at
 * the same time. */
constexpr size_t kNumRemembered = 64;
/** Range of the control period, ms. Chosen: a robot's servos get new targets at 10 to 500 Hz. */
constexpr int kMaxTickMs = 100;
/** Upper limits of world commands. Chosen: beyond the field, and beyond what a robot survives. */
constexpr double kMaxPace = 1000;
/** N s. */
constexpr double kMaxImpulse = 100;
/** m, and m/s. */
constexpr double kMaxPosition = 100;
/** Most robots of a world. Chosen: twice a match of five against five. */
constexpr size_t kMaxRobots = 20;
/** Least distance between the torsos of a robot that is added and another one, m. Chosen: two NAOs
 * stand beside each other. */
constexpr double kLeastDistance = 0.4;
/** Distance of a dragged point from its link's origin, m: more than a link is long. */
constexpr double kMaxDragPoint = 1;

/** Ticks after which an answer is none of this simulator's. Chosen: a second; a controller answers
 * within one. */
constexpr int64_t kMaxCommandAge = 100;

/** Empty if none were requested. */
std::optional<DisturbanceSet> find_disturbances(const SimOptions& options) {
  if (options.disturbances.empty()) return std::nullopt;
  return DisturbanceSet::find(options.disturbances);
}

WorldOptions world_options(const SimOptions& options) {
  WorldOptions result;
  result.engine = options.engine;
  result.num_threads = options.num_threads;
  result.seed = options.seed;
  if (const auto disturbances = find_disturbances(options)) {
    draw_world(*disturbances, options.seed, result);
  }
  if (options.tick_ms == -1) return result;
  const int step_ms = static_cast<int>(std::lround(1e3 * result.step));
  if (options.tick_ms < step_ms || options.tick_ms > kMaxTickMs || options.tick_ms % step_ms != 0) {
    throw ConfigError(fmt::format("control period {} ms is not a multiple of {} ms from {} to {}",
                                  options.tick_ms, step_ms, step_ms, kMaxTickMs));
  }
  result.steps_per_tick = options.tick_ms / step_ms;
  return result;
}

/** Options with teams. */
SimOptions complete(SimOptions options) {
  options.robots = with_teams(std::move(options.robots));
  return options;
}

/** In a match the ball is at the center of the field. */
SceneFile find_scene(const SimOptions& options) {
  SceneFile scene = SceneFile::find(options.scene);
  const bool is_match =
      std::any_of(options.robots.begin(), options.robots.end(),
                  [](const RobotOption& robot) { return robot.team.has_value(); });
  if (is_match && scene.ball) scene.ball->position.setZero();
  return scene;
}

std::shared_ptr<const RobotModel> load_model(const std::string& name) {
  return std::make_shared<const RobotModel>(RobotModel::load(data_path() / "robots" / name));
}

/** @param index  Index of the robot among all that ever were in the world: part of its seed. */
void add_robot_to(World& world, const SimOptions& options, const std::string& name,
                  const std::shared_ptr<const RobotModel>& model, const StartPlace& place,
                  int index) {
  RobotOptions robot;
  robot.name = name;
  robot.posture = options.posture;
  robot.ideal_sensors = options.ideal_sensors;
  if (const auto disturbances = find_disturbances(options)) {
    draw_robot(*disturbances, options.seed, index, *model, world.options(), robot);
  }
  if (options.command_latency_ticks >= 0) {
    robot.command_latency_ticks = options.command_latency_ticks;
  }
  robot.position = place.position;
  robot.heading = place.heading;
  world.add_robot(model, robot);
}

/** @return Their number. */
int add_robots(const SimOptions& options, World& world) {
  const std::vector<StartPlace> places = start_places(options.robots, world.scene());
  // Robots of one model share its description.
  std::map<std::string, std::shared_ptr<const RobotModel>> models;
  int index = 0;
  for (const RobotOption& robot : options.robots) {
    std::shared_ptr<const RobotModel>& model = models[robot.model];
    if (!model) model = load_model(robot.model);
    add_robot_to(world, options, robot.name, model, places[static_cast<size_t>(index)], index);
    ++index;
  }
  return index;
}

/** @throws ConfigError, ModelError */
std::optional<LolaRobot> make_lola(const SimOptions& options, const World& world) {
  if (options.lola_socket.empty()) return std::nullopt;
  if (world.num_robots() != 1) {
    throw ConfigError(fmt::format("LoLA serves one robot, and there are {}", world.num_robots()));
  }
  LolaRobot lola(world.robot(0).model());
  lola.update(world.sensors(0), world.targets(0), 0);
  return lola;
}

/** Whether motors would turn differently; where a robot is limp, targets do not matter. */
bool have_changed(const MotorTargets& before, const MotorTargets& now) {
  return before.stiffness != now.stiffness ||
         ((before.position - now.position).array() * now.stiffness.array() != 0).any();
}

bool is_within(const Eigen::Vector3d& v, double limit) {
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= limit;
}

std::string to_text(const Eigen::Vector3d& v) {
  return fmt::format("({}, {}, {})", v.x(), v.y(), v.z());
}

}  // namespace

SimCore::SimCore(const SimOptions& options)
    : options_(complete(options)),
      world_(find_scene(options_), world_options(options_)),
      scheduler_(static_cast<int>(options.robots.size()), world_.options().period(),
                 options.lock_step, options.pace) {
  num_drawn_robots_ = add_robots(options_, world_);
  for (int i = 0; i < world_.num_robots(); ++i) {
    targets_.push_back(world_.targets(i));
    lights_.emplace_back(names_of(load_robot_lights(world_.robot(i).model())));
  }
  lola_ = make_lola(options_, world_);
}

void SimCore::take_lola_command(const LolaCommand& command, double now) {
  const JointCommand joints = lola_->take(command, world_.targets(0), world_.tick());
  // Names and numbers are valid by construction.
  (void)take_joint_command(0, joints, now);
}

std::optional<std::string> SimCore::take_joint_command(int robot, const JointCommand& command,
                                                       double now) {
  // Such a command was sent before a reset.
  if (command.tick > world_.tick()) {
    return fmt::format("it answers tick {}, and the world is at tick {}", command.tick,
                       world_.tick());
  }
  // In real time the answer of a program of this system comes in time. Programs that answer no
  // state leave the tick at 0.
  if (command.tick > 0 && !scheduler_.is_lock_step() && scheduler_.pace() == 1 &&
      world_.tick() - command.tick > kMaxCommandAge) {
    return fmt::format("it answers tick {}, long before {}: that of another simulator on this bus?",
                       command.tick, world_.tick());
  }
  MotorTargets targets = targets_[robot];
  if (auto reason = merge_joint_command(world_.robot(robot).model(), command, targets)) {
    return reason;
  }
  const bool have_new_targets = have_changed(targets_[robot], targets);
  targets_[robot] = std::move(targets);
  // Merged, as a command may name some joints only.
  world_.set_targets(robot, targets_[robot]);
  // A controller that has a new command for the robot answers a tick again.
  const bool is_repeated = scheduler_.note_command(robot, command.tick, now);
  if (have_new_targets || is_repeated) wake(now);
  return std::nullopt;
}

bool SimCore::take_world_command(const WorldCommand& command, double now) {
  const std::pair<std::string, int64_t> key{command.source, command.id};
  // Senders repeat a command until world_truth_t reports its number: "step" or "push" must act
  // once.
  if (std::find(executed_.begin(), executed_.end(), key) != executed_.end()) return false;
  executed_.push_back(key);
  if (executed_.size() > kNumRemembered) executed_.pop_front();
  wake(now);
  outcome_ = {command.source, command.id, execute(command, now)};
  return true;
}

std::string SimCore::execute(const WorldCommand& command, double now) {
  const std::string& name = command.name;
  if (name == "pause") {
    scheduler_.pause();
    return "";
  }
  if (name == "resume") {
    scheduler_.resume(now);
    return "";
  }
  if (name == "step") return step(command, now);
  if (name == "reset") return reset(now);
  if (name == "set-pace") return set_pace(command, now);
  if (name == "place-robot") return place_robot(command);
  if (name == "place-ball") return place_ball(command);
  if (name == "push") return push(command);
  if (name == "touch") return touch(command);
  if (name == "drag" || name == "drag-in-torso") return drag(command);
  if (name == "add-robot") return add_robot(command);
  if (name == "remove-robot") return remove_robot(command);
  return fmt::format("unknown world command \"{}\"", name);
}

std::string SimCore::step(const WorldCommand& command, double now) {
  if (command.num_ticks < 1) {
    return fmt::format("number of ticks {} must be 1 or more", command.num_ticks);
  }
  scheduler_.step(command.num_ticks, now);
  return "";
}

std::string SimCore::reset(double now) {
  world_.reset();
  if (lola_) lola_->update(world_.sensors(0), world_.targets(0), 0);
  for (int i = 0; i < world_.num_robots(); ++i) targets_[i] = world_.targets(i);
  for (SimLights& lights : lights_) lights.reset();
  scheduler_.reset(now);
  return "";
}

std::string SimCore::set_pace(const WorldCommand& command, double now) {
  // Written so that NaN fails, too.
  if (!(command.pace >= 0 && command.pace <= kMaxPace)) {
    return fmt::format("pace {} is outside [0, {}]", command.pace, kMaxPace);
  }
  scheduler_.set_pace(command.pace, now);
  return "";
}

std::string SimCore::place_robot(const WorldCommand& command) {
  const int robot = find_robot(command.robot);
  if (robot < 0) return fmt::format("there is no robot \"{}\"", command.robot);
  if (!is_within(command.position, kMaxPosition) || command.position.z() < 0) {
    return fmt::format("position {} must be finite, within {} m, and not below the floor",
                       to_text(command.position), kMaxPosition);
  }
  const Posture* posture = nullptr;
  if (!command.posture.empty()) {
    posture = world_.robot(robot).model().find_posture(command.posture);
    if (posture == nullptr) return fmt::format("there is no posture \"{}\"", command.posture);
  }
  const Eigen::Vector4d& q = command.orientation;
  const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
  const double norm = orientation.norm();
  // Senders of rounded numbers are accepted.
  if (norm != 0 && !(std::abs(norm - 1) < 0.01)) {
    return fmt::format("orientation has the norm {} and must be a unit quaternion", norm);
  }
  world_.place_robot(robot, posture, command.position, norm != 0 ? &orientation : nullptr);
  targets_[robot] = world_.targets(robot);
  return "";
}

std::string SimCore::place_ball(const WorldCommand& command) {
  if (!world_.has_ball()) return fmt::format("scene {} has no ball", options_.scene);
  if (!is_within(command.position, kMaxPosition) || command.position.z() < 0) {
    return fmt::format("position {} must be finite, within {} m, and not below the floor",
                       to_text(command.position), kMaxPosition);
  }
  if (!is_within(command.velocity, kMaxPosition)) {
    return fmt::format("velocity {} must be finite and within {} m/s", to_text(command.velocity),
                       kMaxPosition);
  }
  world_.place_ball(command.position, command.velocity);
  return "";
}

std::string SimCore::push(const WorldCommand& command) {
  if (!is_within(command.impulse, kMaxImpulse)) {
    return fmt::format("impulse {} must be finite and within {} N s", to_text(command.impulse),
                       kMaxImpulse);
  }
  if (command.link == "ball") {
    if (!world_.has_ball()) return fmt::format("scene {} has no ball", options_.scene);
    world_.push_ball(command.impulse);
    return "";
  }
  const int robot = find_robot(command.robot);
  if (robot < 0) return fmt::format("there is no robot \"{}\"", command.robot);
  const RobotModel& model = world_.robot(robot).model();
  const int link = command.link.empty() ? 0 : model.find_link(command.link);
  if (link < 0) return fmt::format("there is no link \"{}\"", command.link);
  world_.push(robot, link, command.impulse);
  return "";
}

std::string SimCore::drag(const WorldCommand& command) {
  const int robot = find_robot(command.robot);
  if (robot < 0) return fmt::format("there is no robot \"{}\"", command.robot);
  const int link = world_.robot(robot).model().find_link(command.link);
  if (link < 0) return fmt::format("there is no link \"{}\"", command.link);
  if (!is_within(command.point, kMaxDragPoint)) {
    return fmt::format("point {} must be finite and within {} m of the link's origin",
                       to_text(command.point), kMaxDragPoint);
  }
  if (!is_within(command.target, kMaxPosition)) {
    return fmt::format("target {} must be finite and within {} m", to_text(command.target),
                       kMaxPosition);
  }
  world_.drag(robot, {link, command.point, command.target, command.name == "drag-in-torso"});
  return "";
}

std::string SimCore::touch(const WorldCommand& command) {
  if (!lola_) return "only a robot behind LoLA has buttons and touch sensors";
  if (command.num_ticks < 1) {
    return fmt::format("number of ticks {} must be 1 or more", command.num_ticks);
  }
  if (lola_->touch(command.link, command.num_ticks)) return "";
  return fmt::format("there is no button or touch sensor \"{}\"", command.link);
}

std::string SimCore::add_robot(const WorldCommand& command) {
  if (lola_) return "LoLA serves one robot";
  if (!world_.can_change_robots()) {
    return fmt::format("the engine {} cannot add robots", options_.engine);
  }
  if (std::string fault = fault_of_robot_name(command.robot); !fault.empty()) return fault;
  if (find_robot(command.robot) >= 0) return fmt::format("there is a robot {}", command.robot);
  if (options_.robots.size() >= kMaxRobots) return fmt::format("there are {} robots", kMaxRobots);
  const std::string& model = command.model.empty() ? options_.robots[0].model : command.model;
  if (model.starts_with('.') || model.find('/') != std::string::npos) {
    return fmt::format("\"{}\" is not a valid name of a robot's folder", model);
  }
  if (!is_within(command.position, kMaxPosition)) {
    return fmt::format("position {} must be finite and within {} m", to_text(command.position),
                       kMaxPosition);
  }
  const StartPlace place{command.position.head<2>(), 0};
  for (int i = 0; i < world_.num_robots(); ++i) {
    if ((world_.robot(i).state().position.head<2>() - place.position).norm() < kLeastDistance) {
      return fmt::format("{} is nearer than {} m to that place", options_.robots[i].name,
                         kLeastDistance);
    }
  }
  try {
    add_robot_to(world_, options_, command.robot, load_model(model), place, num_drawn_robots_);
  } catch (const Error& error) {
    return error.what();
  }
  ++num_drawn_robots_;
  const int robot = world_.num_robots() - 1;
  targets_.push_back(world_.targets(robot));
  lights_.emplace_back(names_of(load_robot_lights(world_.robot(robot).model())));
  scheduler_.add_robot();
  options_.robots.push_back({command.robot, model});
  return "";
}

std::string SimCore::remove_robot(const WorldCommand& command) {
  const int robot = command.robot.empty() ? -1 : find_robot(command.robot);
  if (robot < 0) return fmt::format("there is no robot \"{}\"", command.robot);
  if (world_.num_robots() == 1) return "the last robot cannot be removed";
  if (!world_.can_change_robots()) {
    return fmt::format("the engine {} cannot remove robots", options_.engine);
  }
  world_.remove_robot(robot);
  targets_.erase(targets_.begin() + robot);
  lights_.erase(lights_.begin() + robot);
  scheduler_.remove_robot(robot);
  options_.robots.erase(options_.robots.begin() + robot);
  return "";
}

int SimCore::find_robot(const std::string& name) const {
  if (name.empty()) return 0;
  const auto found = std::find_if(options_.robots.begin(), options_.robots.end(),
                                  [&name](const RobotOption& robot) { return robot.name == name; });
  return found == options_.robots.end() ? -1 : static_cast<int>(found - options_.robots.begin());
}

double SimCore::run_tick(double now) {
  const double delay = scheduler_.begin_tick(world_.tick(), now);
  world_.step_tick();
  for (SimLights& lights : lights_) lights.step(world_.options().period());
  if (lola_) lola_->update(world_.sensors(0), world_.targets(0), world_.options().period());
  // Lost readings are never answered: in lock-step the next tick must not wait for it.
  for (int i = 0; scheduler_.is_lock_step() && i < world_.num_robots(); ++i) {
    if (world_.are_readings_lost(i)) scheduler_.note_command(i, world_.tick(), now);
  }
  update_rest();
  return delay;
}

void SimCore::update_rest() {
  // What moves in the middle of a batch is controlled from this tick on.
  if (!rest_.step(world_)) scheduler_.drop_batch();
  is_state_due_ = !scheduler_.is_in_batch();
  if (rest_.is_at_rest(world_) && is_state_due_ && !lola_ && !scheduler_.is_lock_step() &&
      !scheduler_.is_paused() && scheduler_.pace() == 1) {
    scheduler_.rest(world_.tick(), rest_.has_image_request(world_)
                                       ? TickScheduler::kRestTicksWithImages
                                       : TickScheduler::kRestTicks);
  }
}

}  // namespace nao::sim
