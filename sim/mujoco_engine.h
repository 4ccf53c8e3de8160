#pragma once

#include <vector>

#include "sim/engine.h"
#include "sim/mujoco_model.h"

namespace nao::sim {

/** MuJoCo's dynamics, integrator, contact law (its soft constraints with default parameters), joint
 * stops and dry friction, with our servos and motors, for a robot that is tuned on the fast engine
 * to be tested on another one. Built only where MuJoCo is installed. */
class MujocoEngine : public Engine {
 public:
  /** @param options, bodies  Must outlive this. */
  MujocoEngine(const SceneFile& scene, const WorldOptions& options, MovingBodies& bodies);

  const char* name() const override { return "mujoco"; }
  /** Rebuilds the whole model. */
  void add_robot() override;
  void step() override;
  void reset() override;
  void forget_contacts_of_robot(int robot) override;
  void forget_contacts_of_ball() override;

  int64_t num_steps() const override { return num_steps_; }
  const std::vector<Contact>& contacts() const override { return contacts_; }
  int64_t num_dropped_contacts() const override;

  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }

 private:
  /** The surface to which a geom belongs. */
  struct Geom {
    Surface surface;
    /** Foot that it is a point of: 0 left, 1 right, -1 none. */
    int foot = -1;
  };

  void build();
  void identify_geoms();
  void apply_forces(int robot);
  void apply_forces_on_ball();
  void read_contacts();
  void read_states();
  /** Takes over the states of all bodies, without contacts. */
  void write_states();
  void write_ball();
  bool has_failed() const;

  std::vector<StaticShape> statics_;
  MujocoModelPointer model_;
  MujocoDataPointer data_;
  std::vector<MujocoRobot> robots_;
  /** Addresses of the ball; -1 without one. */
  int ball_position_ = -1;
  int ball_dof_ = -1;
  std::vector<Geom> geoms_;
  std::vector<Contact> contacts_;
  /** State of each robot, for read_states(). */
  std::vector<TreeState> states_;
  int64_t num_steps_ = 0;
};

}  // namespace nao::sim
