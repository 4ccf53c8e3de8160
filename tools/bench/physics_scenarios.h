#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** Period of joint targets, s. */
inline constexpr double kControlPeriod = 0.01;

/** The model data/robots/nao, loaded once. */
std::shared_ptr<const RobotModel> nao_model();

/** Motion of the robot, in both simulators. */
struct PhysicsScenario {
  std::string name;
  std::string posture{};
  /** Height of the start above the standing one, m. */
  double height = 0;
  /** Zero joint stiffness. */
  bool is_limp = false;
  /** Joint targets of each tick; the last ones are held. Empty: the posture's angles. */
  std::vector<Eigen::VectorXd> targets;
};

/** Ten seconds of the motion core's walk at 0.1 m/s, as joint targets. */
PhysicsScenario walking();

/** One second of free fall with oscillating joints; the legs are spread so that they do not
 * collide. */
PhysicsScenario falling();

}  // namespace nao
