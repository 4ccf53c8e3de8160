#pragma once

#include <naolcm/world_truth_t.hpp>
#include <string>
#include <vector>

#include "rendering/world_state.h"
#include "robot_model/robot_model.h"

/** From messages to what pictures are made of. All throw nao::Error, saying what is wrong, when a
 * joint is unknown, lists differ in length, a number is not finite or a quaternion is no rotation.
 */
namespace nao {

/** Positions in motor order; a motor that the message does not name stands at 0.
 * @param names, position  As messages list them: rad (hands: opening). */
std::vector<double> decode_positions(const RobotModel& model, const std::vector<std::string>& names,
                                     const std::vector<double>& position);

/** @param position  m. @param quaternion  (w, x, y, z). */
Eigen::Isometry3d decode_pose(const double (&position)[3], const double (&quaternion)[4]);

WorldState decode_truth(const RobotModel& model, const naolcm::world_truth_t& truth);

}  // namespace nao
