#pragma once

#include <Eigen/Core>

#include "rendering/light.h"

namespace nao {

/** Light and materials of the surroundings; the defaults are those of the viewer and of the head
 * cameras, other values vary images to test and train perception with. Colors are linear. */
struct SceneAppearance {
  /** Unit vector towards the light, in the world; its z must be above 0.2. */
  Eigen::Vector3f light_direction = kLightDirection;
  /** The intensities are chosen so that white plastic facing the light is just below full
   * brightness. */
  Eigen::Vector3f direct_light{0.66f, 0.64f, 0.59f};
  /** Factor on the light from sky, ground and the opposite side. */
  Eigen::Vector3f ambient_light = Eigen::Vector3f::Ones();
  /** Stripe of the world without a part of the direct light, as behind a beam at a window: unit
   * normal (x, y), offset along it and half width, m. */
  Eigen::Vector4f shade{1, 0, 0, 0};
  /** Part of the direct light that the stripe lacks, 0 to 1. */
  float shade_depth = 0;
  /** Mean albedo of the carpet and of its lines. */
  Eigen::Vector3f carpet{0.055f, 0.235f, 0.075f};
  Eigen::Vector3f line = Eigen::Vector3f::Constant(0.80f);
  /** Part of the lines' paint that is worn off in patches, 0 to 1. */
  float line_wear = 0;
  /** Relative variation of the carpet's brightness over centimetres, 0 to 1. */
  float carpet_texture = 0;
};

}  // namespace nao
