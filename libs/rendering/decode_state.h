#pragma once

#include <string>
#include <vector>

#include "rendering/world_state.h"
#include "robot_model/robot_model.h"
#include "robot_model/robot_models.h"

namespace naolcm {
class world_truth_t;
}

/** Converts messages to states that can be drawn. All functions throw nao::MessageError, with the
 * reason, if a joint is unknown, arrays differ in length or a number is not finite. */
namespace nao {

/** Joint positions in motor order; a motor that the message does not list is at 0.
 * @param names, position  Arrays of a message: rad (hands: opening). */
std::vector<double> decode_positions(const RobotModel& model, const std::vector<std::string>& names,
                                     const std::vector<double>& position);

/** The visible part of the simulated world. @param models  Loads those that it does not have. */
WorldState decode_truth(RobotModels& models, const naolcm::world_truth_t& truth);

}  // namespace nao
