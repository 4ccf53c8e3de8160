#include "daemons/speaker/espeak_synthesizer.h"

#include <espeak-ng/speak_lib.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include "common/error.h"

namespace nao::speaker {
namespace {

/** Longest sound of a text, s. Chosen: 1000 bytes at half speed take about 2.5 minutes; a text of
 * digits or symbols, whose names are long, may take more. The rest is cut off. */
constexpr int kMaxDuration = 300;
/** Full volume in espeak-ng's unit (speak_lib.h, espeakVOLUME). */
constexpr double kFullVolume = 100;

bool was_used = false;

/** Receives the library's samples. */
struct Target {
  std::vector<int16_t>* samples = nullptr;
  size_t max_samples = 0;
  bool has_failed = false;
};
Target target;

/** @return 0 to continue, 1 to end the synthesis. */
int take_samples(short* samples, int num_samples, espeak_EVENT* /*events*/) {
  if (samples == nullptr || target.samples == nullptr) return 0;
  const size_t space = target.max_samples - target.samples->size();
  const size_t num_taken = std::min(space, static_cast<size_t>(std::max(0, num_samples)));
  try {
    target.samples->insert(target.samples->end(), samples, samples + num_taken);
  } catch (const std::exception&) {
    // No exception may pass through the library.
    target.has_failed = true;
  }
  return target.has_failed || num_taken == space ? 1 : 0;
}

/** espeak-ng's name of the voice of a language. */
std::string voice_of(std::string_view language) {
  return language == "zh" ? "cmn" : std::string(language);
}

}  // namespace

EspeakSynthesizer::EspeakSynthesizer() {
  if (std::exchange(was_used, true)) throw Error("there was another EspeakSynthesizer");
  sample_rate_ =
      espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr, espeakINITIALIZE_DONT_EXIT);
  if (sample_rate_ <= 0) {
    throw Error("espeak-ng finds no voices; install the package espeak-ng-data");
  }
  espeak_SetSynthCallback(take_samples);
}

EspeakSynthesizer::~EspeakSynthesizer() {
  espeak_Terminate();
}

std::optional<Speech> EspeakSynthesizer::synthesize(const SpeechCommand& command) {
  if (espeak_SetVoiceByName(voice_of(command.language).c_str()) != EE_OK) return std::nullopt;
  const auto set = [](espeak_PARAMETER parameter, double value) {
    return espeak_SetParameter(parameter, static_cast<int>(std::lround(value)), 0) == EE_OK;
  };
  if (!set(espeakRATE, espeakRATE_NORMAL * command.rate) ||
      !set(espeakVOLUME, kFullVolume * command.volume)) {
    return std::nullopt;
  }
  Speech speech;
  speech.sample_rate = sample_rate_;
  target = {&speech.samples, static_cast<size_t>(sample_rate_) * kMaxDuration, false};
  // The character encoding is the only flag: see the class.
  const espeak_ERROR error = espeak_Synth(command.text.c_str(), command.text.size() + 1, 0,
                                          POS_CHARACTER, 0, espeakCHARS_UTF8, nullptr, nullptr);
  const bool has_failed = target.has_failed || error != EE_OK;
  target = {};
  if (has_failed) return std::nullopt;
  return speech;
}

}  // namespace nao::speaker
