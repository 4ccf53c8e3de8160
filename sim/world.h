#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"
#include "sim/contact.h"
#include "sim/engine.h"
#include "sim/moving_bodies.h"
#include "sim/sensors.h"
#include "sim/sim_robot.h"
#include "sim/world_options.h"

namespace nao::sim {

/** A simulated world: a floor, robots, and, if the scene has them, a ball and goals.
 *
 * Frame W: x along the field, y left, z up, origin on the ground at the center of the field.
 * SI units and rad. The same calls on the same build give the same bits, with any number of
 * threads: no clock, file or log is used here. step_tick() allocates nothing with the fast engine.
 *
 *     World world(SceneFile::find("soccer"));
 *     const int robot = world.add_robot(model);
 *     for (;;) {
 *       const SensorReadings& sensed = world.sensors(robot);
 *       world.set_targets(robot, decide(sensed));
 *       world.step_tick();
 *     }
 *
 * It has more than 25 methods since it is the whole interface of the physics: users change robots
 * and ball only through it (robot() is const). The work is done by Engine, SimRobot and Ball. */
class World {
 public:
  using Stage = Engine::Stage;

  /** @throws ConfigError  if an option is outside its range. */
  explicit World(const SceneFile& scene, const WorldOptions& options = {});
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /** Adds a robot, at rest with servos on. Robots may have different models. The ticks of one that
   * is added after the first tick are the world's, until a reset.
   * @throws ModelError, ConfigError  if the physics does not support the model, or a posture is
   * unknown. @return Its index, from 0. */
  int add_robot(std::shared_ptr<const RobotModel> model, const RobotOptions& options = {});

  /** Whether robots may be added after the first tick, and removed: with the fast engine. */
  bool can_change_robots() const { return engine_->can_change_robots(); }
  /** Removes a robot; only if can_change_robots(). The indices of those after it decrease by one.
   */
  void remove_robot(int robot);

  int num_robots() const { return bodies_.num_robots(); }
  const SimRobot& robot(int index) const { return *bodies_.robots[index]; }
  const SceneFile& scene() const { return scene_; }
  const WorldOptions& options() const { return options_; }
  const Floor& floor() const { return floor_; }

  /** Sets the targets of all motors from the next tick on (later by the robot's command latency).
   * Positions beyond a joint's range press the joint against its stop.
   * @param targets  (num_motors) each, finite, stiffness 0 to 1. */
  void set_targets(int robot, const MotorTargets& targets);
  const MotorTargets& targets(int robot) const { return bodies_.robots[robot]->targets(); }

  /** One control tick: steps_per_tick steps, then new sensor readings. */
  void step_tick();
  /** One physics step, without sensors, for benchmarks and tests. */
  void step();

  int64_t tick() const { return tick_; }
  /** Simulated time since the start or reset, s. */
  double time() const;
  const SensorReadings& sensors(int robot) const {
    return bodies_.robots[robot]->sensors().readings();
  }

  /** Whether this tick's readings do not arrive (RobotErrors::sensor_loss); so do targets that are
   * set in some ticks (command_loss). */
  bool are_readings_lost(int robot) const { return bodies_.robots[robot]->are_readings_lost(); }

  bool has_ball() const { return bodies_.ball.has_value(); }
  /** At rest at the origin in a scene without a ball. */
  const BallState& ball() const;
  /** Contact points with a force in the last step. A pair of bodies may have several. */
  const std::vector<Contact>& contacts() const { return engine_->contacts(); }

  /** Resets everything to the start, at tick 0. Only the sensors' noise continues. */
  void reset();
  /** Places a robot at rest. @param posture  Angles of all motors, or nullptr to keep them.
   * @param position  x, y of the torso, and least height of the robot over the floor; m.
   * @param orientation  Orientation of the torso. nullptr: as the posture rests, facing along x. */
  void place_robot(int robot, const Posture* posture, const Eigen::Vector3d& position,
                   const Eigen::Quaterniond* orientation = nullptr);
  /** @param position  x, y, and height of the ball's lowest point over the floor; m. Without a
   * ball: no effect. */
  void place_ball(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity);
  /** Impulse at a link's center of mass in the next step, N s, in W. */
  void push(int robot, int link, const Eigen::Vector3d& impulse);
  /** Pulls a point of a link to a target, for 0.2 s or until the next call. */
  void drag(int robot, const LinkDrag& drag);
  /** Without a ball: no effect. */
  void push_ball(const Eigen::Vector3d& impulse);

  /** How often since reset() a robot or the ball has left all physical bounds (see
   * SimRobot::is_within_bounds()) and was put back to its start. */
  int64_t num_bad_states() const { return num_bad_states_; }
  /** Contacts since reset() that carried no force, because a step had more than the reserved memory
   * holds (64, and 96 for each robot). */
  int64_t num_dropped_contacts() const { return engine_->num_dropped_contacts(); }
  /** Kinetic (with rotors) and potential energy of robots and ball, and the energy in the springs
   * of contacts and joint stops, J. */
  double energy() const;
  /** Calls `probe(stage, user)` after each stage of every step; for measurements. */
  void set_stage_probe(Engine::StageProbe probe, void* user) {
    engine_->set_stage_probe(probe, user);
  }
  /** Iterations of the constraint solver in the last step. */
  int last_iterations() const { return engine_->last_iterations(); }

 private:
  /** Puts back bodies that have left all physical bounds. */
  void check_states();
  void return_to_start(int robot);
  void return_ball_to_start();

  SceneFile scene_;
  /** Its materials are those for the heaviest robot, see Materials::bear(). */
  WorldOptions options_;
  Materials materials_;
  double max_mass_ = 0;
  Floor floor_;
  MovingBodies bodies_;
  std::unique_ptr<Engine> engine_;
  int64_t tick_ = 0;
  int64_t num_bad_states_ = 0;
};

}  // namespace nao::sim
