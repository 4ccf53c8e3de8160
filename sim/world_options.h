#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

namespace nao::sim {

/** What surfaces are like. Coulomb friction is dimensionless. */
struct Materials {
  /** Robot on floor. Assumed for plastic soles on carpet; published walks were tuned on 0.5-1. */
  double floor_friction = 0.8;
  /** Robot on itself, on other robots and on goal posts: smooth plastic, assumed. */
  double robot_friction = 0.4;
  /** Ball on floor; B-Human's simulation of the SPL ball. */
  double ball_friction = 0.3;
  /** Rolling resistance: deceleration of a rolling ball, m/s^2; SPL carpet, B-Human. */
  double ball_rolling_deceleration = 0.3;
  /** Of the ball on floor, robots and posts: speed after over speed before. Soft foam on carpet,
   * assumed. */
  double ball_restitution = 0.5;
  /** Spring and damper of one contact point, N/m and N s/m, and the same along the surface. Stiff
   * enough that walking speed does not change with more, soft enough to converge (measured). */
  double contact_stiffness = 2e4;
  double contact_damping = 150;
  double tangent_stiffness = 2e4;
  double tangent_damping = 150;
};

/** How a world steps. */
struct WorldOptions {
  /** Physics step, s, and steps per control tick. */
  double step = 0.002;
  int steps_per_tick = 5;
  /** m/s^2, in W. Tilted, it makes an incline of the floor. */
  Eigen::Vector3d gravity{0, 0, -9.81};
  /** Of all noise. */
  uint64_t seed = 1;
  Materials materials;
  /** Contact solver: most sweeps, and the change of velocity, m/s or rad/s, that ends them. */
  int max_sweeps = 50;
  double tolerance = 1e-5;
  /** Corners of each sole that touch the floor. */
  int num_sole_points = 8;
};

/** How a robot is built and where it starts. */
struct RobotOptions {
  std::string name = "NAO";
  /** Posture that it stands in and holds until commands come. */
  std::string posture = "StandInit";
  /** On the ground, m, and direction it looks, rad. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading = 0;
  /** Factor on all masses; on the motors' torques; on the friction of its soles. For trials that
   * want every robot a little different. */
  double mass_scale = 1;
  double torque_scale = 1;
  double friction_scale = 1;
  /** Control ticks between setting a target and the motors' following it, 0 to 10. A real NAO: 1.
   */
  int command_latency_ticks = 1;
  /** Hold the torso fast where it starts, as on a work-stand. */
  bool is_on_stand = false;
  /** Height of the robot's lowest point at the start, m. */
  double height = 0;
  /** Sensors without quantization, noise, bias, range or drift. */
  bool ideal_sensors = false;
};

}  // namespace nao::sim
