#pragma once

#include <string>

#include "robot_model/robot_model.h"

namespace nao {

/** First lines of a gait.yaml that has not been tuned. */
inline constexpr const char* kUntunedGait = "not tuned yet";

/** Factors of some parameters. */
struct GaitFactors {
  double swing_height = 1;
  double hip_height = 1;
  double step_duration = 1;
  double foot_distance = 1;
};

/** gait.yaml of a robot that has not walked yet, scaled by its leg length l and foot size: lengths
 * with l, times with sqrt(l / g), velocities with sqrt(g l), so that the walk has the Froude number
 * of the walks that the scales come from. nao-walk-tuner starts from it.
 *
 * Source: R. Alexander, "The gaits of bipedal and quadrupedal animals", IJRR 3(2), 1984 (dynamic
 * similarity).
 * @return Empty if the legs have no inverse kinematics. */
std::string make_gait_text(const RobotModel& model, const GaitFactors& factors = {});

}  // namespace nao
