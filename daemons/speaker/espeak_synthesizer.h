#pragma once

#include "daemons/speaker/synthesizer.h"

namespace nao::speaker {

/** Uses espeak-ng's library: synthesis in memory, without a shell, another process or a file of the
 * text. Markup (SSML), phonemes in brackets and embedded commands are not enabled, so that a text
 * is only ever spoken.
 *
 * The library's state is global, and espeak-ng 1.51 hangs when it is initialized and terminated a
 * second time, so that a process may have one object only. */
class EspeakSynthesizer : public Synthesizer {
 public:
  /** @throws Error  if espeak-ng's voices are not installed, or there was another object. */
  EspeakSynthesizer();
  ~EspeakSynthesizer() override;
  EspeakSynthesizer(const EspeakSynthesizer&) = delete;
  EspeakSynthesizer& operator=(const EspeakSynthesizer&) = delete;

  std::optional<Speech> synthesize(const SpeechCommand& command) override;

 private:
  int sample_rate_ = 0;
};

}  // namespace nao::speaker
