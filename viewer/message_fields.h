#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace nao {

/** Receives a number of a message: its name, such as "joint_position[HeadYaw]", and its value. */
using FieldVisitor = std::function<void(const std::string& name, double value)>;

/** Visits every number of an encoded message, whichever of the project's types it is.
 * @return false if it is none of them. The code is generated from the .lcm files. */
bool visit_fields(const uint8_t* data, int num_bytes, const FieldVisitor& visitor);

}  // namespace nao
