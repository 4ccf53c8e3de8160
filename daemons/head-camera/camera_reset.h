#pragma once

#include "daemons/head-camera/v4l2_settings.h"

namespace nao::camera {

/** Resets the cameras: writes registers by the I2C bus, with a pause of 0.1 s after each.
 * @throws Error  if the bus cannot be opened or a write fails. */
void reset_cameras(const V4l2ResetSettings& settings);

}  // namespace nao::camera
