#include "viewer/viewer_options.h"

#include "common/error.h"

namespace nao {

void ViewerOptions::validate() const {
  if (width < 320 || width > 4096 || height < 240 || height > 4096) {
    throw ConfigError("the window must be 320x240 to 4096x4096 pixels");
  }
  if (num_frames < 1) throw ConfigError("a screenshot is taken after 1 frame or more");
  if (is_offscreen && screenshot.empty()) {
    throw ConfigError("--offscreen shows nothing: it needs --screenshot FILE");
  }
  if (supersample < 1 || supersample > 4) throw ConfigError("--supersample is 1 to 4");
  if (supersample > 1 && !(is_offscreen && without_panels)) {
    throw ConfigError("--supersample needs --offscreen and --no-panels");
  }
  if (!view.empty() && view.size() != 3 && view.size() != 6) {
    throw ConfigError("--view takes azimuth, elevation, distance and perhaps x, y, z");
  }
  for (const std::string& plot : plots) {
    const size_t colon = plot.find(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == plot.size()) {
      throw ConfigError("--plot takes CHANNEL:FIELD, not \"" + plot + "\"");
    }
  }
}

}  // namespace nao
