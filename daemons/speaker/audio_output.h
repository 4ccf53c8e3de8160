#pragma once

#include <memory>
#include <string>

#include "daemons/speaker/speech_core.h"

namespace nao::speaker {

/** Plays speech on this host. No function blocks. */
class AudioOutput {
 public:
  virtual ~AudioOutput() = default;

  /** Plays a piece after the previous ones; a piece that recalls ends the sound. */
  virtual void play(const AudioPiece& piece) = 0;
  /** Gives the device as many samples as it has room for; to be called every 0.1 s or more often.
   */
  virtual void step() = 0;
};

/** @param name  "none", "alsa", "alsa:DEVICE", or "auto": ALSA's default device, or none if there
 * is none.
 * @return nullptr for none.
 * @throws Error  if the device cannot be opened, or the program was built without ALSA.
 * @throws ConfigError  for another name. */
std::unique_ptr<AudioOutput> make_audio_output(const std::string& name);

/** Opens a device of ALSA. @param device  Its name there, "default". @throws Error */
std::unique_ptr<AudioOutput> open_alsa(const std::string& device);

}  // namespace nao::speaker
