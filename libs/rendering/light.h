#pragma once

#include <Eigen/Core>

namespace nao {

/** Unit vector towards the light, in the world. Chosen: a high light left of the field, so that
 * shadows fall to one side and the front of a robot at the origin, which faces +x, is lit. */
inline const Eigen::Vector3f kLightDirection = Eigen::Vector3f(0.18f, 0.42f, 0.85f).normalized();

}  // namespace nao
