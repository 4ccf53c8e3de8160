#pragma once

#include <string>

#include "robot_model/robot_model.h"

namespace nao {

/** Text of a policy.yaml for the training of a walk (tools/policy-train): it moves the joints of
 * both legs about the ready posture. Frequency of the gait and commands are those of Booster Gym's
 * T1, scaled by the hips' height as a pendulum's period and speed are.
 * @throws ModelError  without a ready posture, or joints that a leg does not share. */
std::string draft_walk_policy(const RobotModel& model);

}  // namespace nao
