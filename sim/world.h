#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "robot_model/closest_points.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"
#include "sim/constraint_solver.h"
#include "sim/sensors.h"
#include "sim/sim_robot.h"
#include "sim/world_options.h"

namespace nao::sim {

/** What touches: a robot's link, the floor, the ball, a goal's posts and crossbar, or its net. */
struct Surface {
  enum class Kind { kFloor, kRobot, kBall, kGoal, kNet };
  Kind kind = Kind::kFloor;
  /** Of kRobot: index of the robot and of its link. */
  int robot = -1;
  int link = -1;
};

/** One point where two surfaces press on each other. */
struct Contact {
  Surface a;
  Surface b;
  /** In W, m, and N on a. */
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_on_a = Eigen::Vector3d::Zero();
};

/** The ball, in W: centre m, velocity m/s, angular velocity rad/s. */
struct BallState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
};

/** A simulated world: a floor, perhaps a ball and goals, and robots.
 *
 * Frame W: x along the field, y left, z up, origin on the ground at the centre of the field.
 * Everything in SI units and rad. The same calls on the same build give the same bits: there is no
 * clock, thread, file or log in here. Nothing is allocated by step_tick().
 *
 *     World world(SceneFile::find("soccer"));
 *     const int robot = world.add_robot(model);
 *     for (;;) {
 *       const SensorReadings& sensed = world.sensors(robot);
 *       world.set_targets(robot, decide(sensed));
 *       world.step_tick();
 *     }
 *
 * Step: semi-implicit Euler; servos, motor lines and viscous friction enter the mass matrix
 * implicitly; contacts, joint stops, dry friction and torque limits are bounds that a projected
 * Gauss-Seidel solver meets. See docs/physics.md. */
class World {
 public:
  explicit World(const SceneFile& scene, const WorldOptions& options = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /** Adds a robot, standing at rest with servos on.
   * @throws ModelError, ConfigError  if the physics cannot carry the model, or a posture is
   * unknown. @return Its index, from 0. */
  int add_robot(std::shared_ptr<const RobotModel> model, const RobotOptions& options = {});

  int num_robots() const { return static_cast<int>(robots_.size()); }
  const SimRobot& robot(int index) const { return *robots_[index]; }
  const SceneFile& scene() const { return scene_; }
  const WorldOptions& options() const { return options_; }

  /** What all motors shall do from the next tick on (later by the robot's command latency).
   * Positions beyond a joint's range are pressed against its stop.
   * @param targets  (num_motors) each, finite, stiffness 0 to 1. */
  void set_targets(int robot, const MotorTargets& targets);
  const MotorTargets& targets(int robot) const { return robots_[robot]->targets_; }

  /** One control tick: steps_per_tick steps, then new sensor readings. */
  void step_tick();
  /** One physics step, without sensors, for benchmarks and tests. */
  void step();

  int64_t tick() const { return tick_; }
  /** Simulated time since the start or reset, s. */
  double time() const;
  const SensorReadings& sensors(int robot) const { return robots_[robot]->sensors().readings(); }

  bool has_ball() const { return scene_.ball.has_value(); }
  const BallState& ball() const { return ball_; }
  /** Of the last step, strongest body pairs not merged. */
  const std::vector<Contact>& contacts() const { return contacts_; }

  /** Everything as at the start, at tick 0, noise included. */
  void reset();
  /** Puts a robot at rest. @param posture  Angles of all motors, rad, or nullptr to keep them.
   * @param position  x, y on the ground, and height of the robot's lowest point; m.
   * @param orientation  Of the torso. Without a value: as the posture rests, looking along x. */
  void place_robot(int robot, const Posture* posture, const Eigen::Vector3d& position,
                   const Eigen::Quaterniond* orientation = nullptr);
  /** @param position  x, y, and height of the ball's lowest point; m. Without a ball: nothing. */
  void place_ball(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity);
  /** Impulse at a link's centre of mass in the next step, N s, in W. */
  void push(int robot, int link, const Eigen::Vector3d& impulse);
  void push_ball(const Eigen::Vector3d& impulse);

  /** Robots that had left all physical bounds and were put back to their start, since reset(). */
  int64_t num_bad_states() const { return num_bad_states_; }
  /** Kinetic (with rotors) and potential energy of robots and ball, and what the springs of
   * contacts and joint stops hold, J. */
  double energy() const;
  /** What a step consists of, in this order. */
  enum class Stage { kDynamics, kCollision, kRows, kSolve, kIntegrate };
  /** Calls `probe(stage, user)` after each stage of every step; for measurements. */
  void set_stage_probe(void (*probe)(Stage, void*), void* user) {
    stage_probe_ = probe;
    stage_probe_user_ = user;
  }
  /** Sweeps of the contact solver in the last step. */
  int last_sweeps() const { return last_sweeps_; }
  const ConstraintSolver& solver() const { return solver_; }

 private:
  /** A contact is made when surfaces will be nearer than this after the step, m. */
  static constexpr double kMargin = 0.0005;

  struct Touch {
    Surface a;
    Surface b;
    int body_a = -1;
    int body_b = -1;
    int block = -1;
    int sole = -1;
    ContactSlot* slot = nullptr;
    Eigen::Vector3d point;
    Eigen::Matrix3d frame;
    double distance = 0;
    double tangent_share = 0;
  };
  struct PairSlots {
    int a;
    int b;
    std::vector<ContactSlot> slots;
  };
  struct StaticShape {
    RoundedBox shape;
    bool is_net = false;
  };

  void build_goals();
  void finish_stage(Stage stage) {
    if (stage_probe_ != nullptr) stage_probe_(stage, stage_probe_user_);
  }
  void begin_step();
  void find_contacts();
  void find_floor_contacts(int robot);
  /** Adds contacts for points that would be in the floor after the step, as the solver's present
   * answer has it. @return Whether there were any. */
  bool add_missed_floor_contacts(int robot);
  bool add_missed_constraints();
  void find_self_contacts(int robot);
  void find_robot_contacts(PairSlots& pair);
  void find_goal_contacts(int robot);
  void find_ball_contacts();
  void place_parts(int robot);
  const RoundedBox& part_shape(int robot, int part);
  void add_contact(const Surface& a, int body_a, const Surface& b, int body_b,
                   const Proximity& proximity, int sole, ContactSlot& slot);
  int add_contact_entries(const Touch& touch, int& count);
  int add_body_entries(const Surface& surface, int body, double sign, const Touch& touch);
  void end_step();
  void check_states();
  Eigen::Vector3d velocity_of(const Surface& surface, int body, const Eigen::Vector3d& point) const;
  double friction_of(const Surface& a, const Surface& b) const;

  SceneFile scene_;
  WorldOptions options_;
  std::vector<std::unique_ptr<SimRobot>> robots_;
  std::vector<int> first_dof_;
  std::vector<StaticShape> statics_;
  BallState ball_;
  Eigen::Vector3d ball_impulse_ = Eigen::Vector3d::Zero();
  int ball_dof_ = -1;
  double ball_inertia_ = 0;

  int64_t tick_ = 0;
  int64_t num_steps_ = 0;
  int64_t num_bad_states_ = 0;
  int last_sweeps_ = 0;
  void (*stage_probe_)(Stage, void*) = nullptr;
  void* stage_probe_user_ = nullptr;
  double elastic_energy_ = 0;

  Eigen::VectorXd z_;
  ConstraintSolver solver_;
  std::vector<Touch> touches_;
  std::vector<Contact> contacts_;
  /** Parts of each robot in W; rotations are filled in when needed. */
  struct PlacedPart {
    RoundedBox shape;
    bool has_rotation = false;
  };
  std::vector<std::vector<PlacedPart>> placed_;
  std::vector<PairSlots> robot_pairs_;
  /** Of the ball with the floor, each part of each robot, and each static shape. */
  ContactSlot ball_floor_slot_;
  std::vector<std::vector<ContactSlot>> ball_robot_slots_;
  std::vector<ContactSlot> ball_static_slots_;
  std::vector<std::vector<ContactSlot>> static_slots_;
  std::vector<int> position_;
  std::vector<int> union_dofs_;
};

}  // namespace nao::sim
