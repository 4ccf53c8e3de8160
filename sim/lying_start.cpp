#include "sim/lying_start.h"

#include <algorithm>
#include <cmath>

#include "sim/world.h"

namespace nao::sim {
namespace {

// Greatest difference from the ready posture, rad, and least height of the robot, m. Chosen.
constexpr double kSpread = 0.5;
constexpr double kHeight = 0.01;

}  // namespace

Posture draw_posture(const RobotModel& model, double spread,
                     const std::function<double(double, double)>& uniform) {
  Posture posture = model.ready_posture();
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const Joint& joint = model.motor_joint(motor);
    double& angle = posture.position[static_cast<size_t>(motor)];
    angle = std::clamp(angle + uniform(-spread, spread), joint.lower, joint.upper);
  }
  return posture;
}

Posture lay_down(World& world, int robot, double side,
                 const std::function<double(double, double)>& uniform) {
  Posture posture = draw_posture(world.robot(robot).model(), kSpread, uniform);
  // Torso horizontal, then rolled about its own long axis to the given side.
  const Eigen::Quaterniond orientation = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()) *
                                         Eigen::AngleAxisd(side, Eigen::Vector3d::UnitZ());
  world.place_robot(robot, &posture, {0, 0, kHeight}, &orientation);
  return posture;
}

}  // namespace nao::sim
