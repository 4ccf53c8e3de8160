#include "daemons/head-camera/head_camera_options.h"

#include <cmath>

#include "common/error.h"
#include "daemons/head-camera/picture_wishes.h"

namespace nao {

void HeadCameraOptions::validate() const {
  const std::string refusal = refuse_wish({camera, width, rate, quality});
  if (!refusal.empty()) throw ConfigError(refusal);
  if (shadow_size < 0 || shadow_size > 4096) {
    throw ConfigError("the shadow map's size must be 0 to 4096 texels");
  }
  if (!(std::abs(k1) <= 2) || !(std::abs(k2) <= 2)) {
    throw ConfigError("the lens's distortion must be two numbers from -2 to 2");
  }
  if (!(noise >= 0 && noise <= 60)) throw ConfigError("the noise must be 0 to 60 levels");
  if (!(exposure >= 0 && exposure <= 0.033)) throw ConfigError("the exposure must be 0 to 33 ms");
}

}  // namespace nao
