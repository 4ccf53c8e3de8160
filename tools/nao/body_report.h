#pragma once

#include <naolcm/body_state_t.hpp>
#include <string>

namespace nao {

/** The condition of a robot's body in a line for users: battery, hottest motor, warnings in words.
 * @param robot  Its name. */
std::string body_report(const std::string& robot, const naolcm::body_state_t& body);

}  // namespace nao
