#include "sim/rest_detector.h"

namespace nao::sim {
namespace {

/** Velocities below which a body is at rest, m/s and rad/s. Chosen: ten times those of a robot that
 * stands with sensor noise, a hundredth of a walking one's. */
constexpr double kMaxSpeed = 0.01;
constexpr double kMaxRate = 0.05;
/** Greatest speed of a joint at rest, rad/s. */
constexpr double kMaxJointSpeed = 0.1;

}  // namespace

bool RestDetector::is_still(const World& world) {
  if (world.ball().velocity.norm() > kMaxSpeed) return false;
  for (int i = 0; i < world.num_robots(); ++i) {
    const SimRobot& robot = world.robot(i);
    if (robot.state().velocity.head<3>().norm() > kMaxRate ||
        robot.state().velocity.segment<3>(3).norm() > kMaxSpeed ||
        robot.motor_velocity().lpNorm<Eigen::Infinity>() > kMaxJointSpeed) {
      return false;
    }
  }
  return true;
}

}  // namespace nao::sim
