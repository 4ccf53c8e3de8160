#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "robot_model/scene_file.h"
#include "sim/contact.h"
#include "sim/moving_bodies.h"
#include "sim/world_options.h"

namespace nao::sim {

/** Advances all moving bodies of a world by time steps.
 *
 * Motors and their servos, sensors and placement belong to SimRobot and are the same in every
 * engine; the engine contributes rigid-body dynamics, contacts, joint stops and friction. */
class Engine {
 public:
  /** Stages of a step of the fast engine, in this order. */
  enum class Stage { kDynamics, kCollision, kRows, kSolve, kIntegrate };
  using StageProbe = void (*)(Stage, void*);

  /** @param options, bodies  Must outlive this. */
  Engine(const WorldOptions& options, MovingBodies& bodies) : options_(options), bodies_(bodies) {}
  virtual ~Engine() = default;

  /** As in WorldOptions::engine. */
  virtual const char* name() const = 0;
  /** Takes in the robot that was added to the bodies last. */
  virtual void add_robot() = 0;
  /** Whether robots may be added after the first step, and removed. */
  virtual bool can_change_robots() const { return false; }
  /** Removes the robot of this index, which was removed from the bodies; only if
   * can_change_robots(). */
  virtual void remove_robot(int /*robot*/) {}
  /** One step, without what robots do at the begin and end of a tick. */
  virtual void step() = 0;
  /** One control tick of WorldOptions::steps_per_tick steps. Only robots that are within bounds
   * after it get new sensor readings. */
  virtual void step_tick();
  /** Forgets all contacts and counts from 0 again. */
  virtual void reset() = 0;

  /** Reports that a body was placed elsewhere. */
  virtual void forget_contacts_of_robot(int robot) = 0;
  virtual void forget_contacts_of_ball() = 0;

  /** Since reset(). */
  virtual int64_t num_steps() const = 0;
  /** Contact points with a force in the last step. */
  virtual const std::vector<Contact>& contacts() const = 0;
  /** Contacts left out since reset() because memory was not sufficient. */
  virtual int64_t num_dropped_contacts() const = 0;
  /** Energy in the springs of the contacts, J; 0 if the engine does not report it. */
  virtual double elastic_energy() const { return 0; }
  /** Iterations of the constraint solver in the last step; 0 if the engine has none. */
  virtual int last_iterations() const { return 0; }
  /** Calls `probe(stage, user)` after each stage of every step, if the engine has stages. */
  virtual void set_stage_probe(StageProbe /*probe*/, void* /*user*/) {}

 protected:
  /** Reads a robot's sensors after a tick, if it is within bounds. */
  void end_tick(int robot);

  const WorldOptions& options_;
  MovingBodies& bodies_;
};

/** Names of the engines of this build. */
std::vector<std::string> engine_names();

/** The engine that WorldOptions::engine names. @param options, bodies  Must outlive it.
 * @throws ConfigError  if there is no such engine, or this build does not have it. */
std::unique_ptr<Engine> make_engine(const SceneFile& scene, const WorldOptions& options,
                                    MovingBodies& bodies);

}  // namespace nao::sim
