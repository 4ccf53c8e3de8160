#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <string>

#include "common/constants.h"
#include "sim/floor.h"
#include "sim/robot_errors.h"

namespace nao::sim {

/** Largest command latency, control ticks. Chosen: more than the latencies that the walk was tested
 * with (nao-trial --latency). */
inline constexpr int kMaxCommandLatencyTicks = 10;

/** Properties of surfaces. Coefficients of Coulomb friction are dimensionless. */
struct Materials {
  /** Robot on floor. Assumed for plastic soles on carpet; published walks were tuned on 0.5-1. */
  double floor_friction = 0.8;
  /** Robot on itself, on other robots and on goal posts: smooth plastic, assumed. */
  double robot_friction = 0.4;
  /** Ball on everything; B-Human's simulation of the SPL ball. */
  double ball_friction = 0.3;
  /** Rolling resistance: deceleration of a rolling ball, m/s^2; SPL carpet, B-Human. */
  double ball_rolling_deceleration = 0.3;
  /** Restitution of the ball on floor, robots and posts: speed after over speed before an impact.
   * Assumed for soft foam on carpet. */
  double ball_restitution = 0.5;
  /** Spring, N/m, and damper, N s/m, of one contact point along the normal, and along the surface
   * while it sticks. Measured: at 3e3 N/m a walk loses 35 to 55 % of its speed, from 2e4 to 1e5 it
   * does not change; stiffer springs need more iterations of the solver. */
  double contact_stiffness = 2e4;
  double contact_damping = 150;
  double tangent_stiffness = 2e4;
  double tangent_damping = 150;

  /** Stiffens the springs and dampers of contact points for a robot that is heavier than
   * kSpringMass, in proportion, so that its weight presses its soles as deep into the floor as that
   * of a robot of kSpringMass. On springs for the weight of a NAO (5.3 kg) a robot of 32 kg would
   * tip over: a sole 10 cm wide on springs of 1e4 N/m resists tilting with less than the robot's
   * weight times its height. @param mass  Mass of the robot, kg. */
  void bear(double mass) {
    const double ratio = std::max(1.0, mass / kSpringMass);
    contact_stiffness *= ratio;
    contact_damping *= ratio;
    tangent_stiffness *= ratio;
    tangent_damping *= ratio;
  }

  /** Greatest mass of a robot for which the springs above are meant, kg. Chosen: just above a
   * NAO's. */
  static constexpr double kSpringMass = 6;
};

/** Time step, solver and surroundings of a world. */
struct WorldOptions {
  /** Physics engine, see engine_names(): "fast", "simbody", or "mujoco" where it was built. */
  std::string engine = "fast";
  /** Threads that step bodies far from each other at the same time, with the engine "fast"; 1
   * to 64. The result does not depend on it. */
  int num_threads = 1;
  /** Length of a physics step, s, and steps per control tick. */
  double step = 0.002;
  int steps_per_tick = 5;
  /** m/s^2, in W. Tilted, it makes an incline of the floor (`floor_slope`). */
  Eigen::Vector3d gravity{0, 0, -kGravity};
  /** Seed of all noise. */
  uint64_t seed = 1;
  Materials materials;
  FloorOptions floor;
  /** Constraint solver: largest number of iterations, and the change of velocity, m/s or rad/s,
   * below which it has converged. */
  int max_iterations = 50;
  double tolerance = 1e-5;
  /** Corners of each sole's outline that collide with the floor. */
  int num_sole_points = 8;
  /** Distance between further points within the outline, m, which collide with a floor that is not
   * flat. Chosen: a third of the usual distance of bumps. */
  double sole_point_spacing = 0.03;

  /** Control period, s. */
  double period() const { return step * steps_per_tick; }
};

/** How a robot is built and where it starts. */
struct RobotOptions {
  /** Part of the seed of the robot's noise. */
  std::string name = "NAO";
  /** Posture that it starts in, and that its servos hold until targets are set. */
  std::string posture{};
  /** Position of the torso on the ground, m, and its heading, rad. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading = 0;
  /** Factors on all masses, on the motors' torques, and on the friction of the robot on the floor:
   * differences between robots, for trials. */
  double mass_scale = 1;
  double torque_scale = 1;
  double friction_scale = 1;
  /** Control ticks until the motors follow a new target, 0 to 10. A real NAO has 1. */
  int command_latency_ticks = 1;
  /** Holds the torso fixed where it starts. */
  bool is_on_stand = false;
  /** Height of the robot's lowest point at the start, m. */
  double height = 0;
  /** Sensors without quantization, noise, bias, range or drift. */
  bool ideal_sensors = false;
  /** Differences of joints, sensors and links from the model. */
  RobotErrors errors;
};

}  // namespace nao::sim
