#include "head_camera_options.h"

#include "common/error.h"
#include "picture_wishes.h"

namespace nao {

void HeadCameraOptions::validate() const {
  const std::string refusal = refuse_wish({camera, width, rate, quality});
  if (!refusal.empty()) throw ConfigError(refusal);
  if (shadow_size < 0 || shadow_size > 4096) {
    throw ConfigError("the shadow map's size must be 0 to 4096 texels");
  }
}

}  // namespace nao
