#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "messages/speech_command.h"

namespace nao::speaker {

/** Sound of a text, one channel. */
struct Speech {
  /** Samples a second. */
  int sample_rate = 0;
  std::vector<int16_t> samples;
};

/** Makes sound of texts. */
class Synthesizer {
 public:
  virtual ~Synthesizer() = default;

  /** @param command  Checked, with a language of kSpeechLanguages.
   * @return Nothing if the synthesizer failed; no samples if nothing of the text is spoken. */
  virtual std::optional<Speech> synthesize(const SpeechCommand& command) = 0;
};

}  // namespace nao::speaker
