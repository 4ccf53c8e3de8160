#include "daemons/speaker/audio_output.h"

#include "common/error.h"
#include "common/logger.h"

namespace nao::speaker {

#ifndef NAO_WITH_ALSA
std::unique_ptr<AudioOutput> open_alsa(const std::string& /*device*/) {
  throw Error("this nao-speaker was built without ALSA; install libasound2-dev and build again");
}
#endif

std::unique_ptr<AudioOutput> make_audio_output(const std::string& name) {
  const std::string prefix = "alsa:";
  if (name == "none") return nullptr;
  if (name == "alsa") return open_alsa("default");
  if (name.starts_with(prefix)) return open_alsa(name.substr(prefix.size()));
  if (name != "auto") {
    throw ConfigError("the output \"" + name + "\" is not none, auto, alsa or alsa:DEVICE");
  }
  try {
    return open_alsa("default");
  } catch (const Error& error) {
    logger::info("no sound on this host: {}", error.what());
    return nullptr;
  }
}

}  // namespace nao::speaker
