#pragma once

#include "daemons/speaker/synthesizer.h"

namespace nao::speaker {

/** Runs another synthesizer, with a child process for each text. espeak-ng 1.51 is not robust: some
 * texts of emoji and combining marks make it write to a null pointer, a letter of a second alphabet
 * makes it read freed memory. Such a fault ends only the child; its text fails, and the next one
 * finds the synthesizer as it was at first. */
class IsolatedSynthesizer : public Synthesizer {
 public:
  /** Processor time of a child for one text, s, after which it is ended. Chosen: a text of 1000
   * bytes takes 0.9 s on a desktop processor and ten times as long on a slow one; the limit is
   * twice that. */
  static constexpr int kMaxProcessorTime = 20;

  /** @param synthesizer  Must outlive this. Used in child processes only.
   * @param max_processor_time  s. */
  explicit IsolatedSynthesizer(Synthesizer& synthesizer,
                               int max_processor_time = kMaxProcessorTime);

  std::optional<Speech> synthesize(const SpeechCommand& command) override;

 private:
  Synthesizer& synthesizer_;
  int max_processor_time_;
};

}  // namespace nao::speaker
