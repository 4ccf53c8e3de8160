#include "viewer/viewer_options.h"

#include "common/error.h"

namespace nao::viewer {

void ViewerOptions::validate() const {
  if (width < 320 || width > 4096 || height < 240 || height > 4096) {
    throw ConfigError("the window size " + std::to_string(width) + "x" + std::to_string(height) +
                      " is outside 320x240 to 4096x4096 pixels");
  }
  if (num_frames < 1) {
    throw ConfigError("--frames " + std::to_string(num_frames) + " is below 1");
  }
  if (is_offscreen && screenshot.empty()) {
    throw ConfigError("--offscreen has no effect without --screenshot FILE");
  }
  if (supersample < 1 || supersample > 4) {
    throw ConfigError("--supersample " + std::to_string(supersample) + " is outside 1 to 4");
  }
  if (supersample > 1 && !(is_offscreen && without_panels)) {
    throw ConfigError("--supersample needs --offscreen and --no-panels");
  }
  if (!view.empty() && view.size() != 3 && view.size() != 6) {
    throw ConfigError("--view has " + std::to_string(view.size()) +
                      " numbers; it takes 3 (azimuth, elevation, distance) or 6 (and x, y, z)");
  }
  for (const std::string& plot : plots) {
    const size_t colon = plot.find(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == plot.size()) {
      throw ConfigError("--plot takes CHANNEL:FIELD, not \"" + plot + "\"");
    }
  }
}

}  // namespace nao::viewer
