#pragma once

#include <array>
#include <naolcm/speech_command_t.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "messages/reason.h"

namespace nao {

/** Speaks a text, or stops speaking; speech_command_t documents every field. */
struct SpeechCommand {
  /** The values are those of speech_command_t::OPERATION_*. */
  enum class Operation { kSay, kStop, kSayAfter };

  Operation operation = Operation::kSay;
  std::string text{};
  std::string language{};
  double volume = 1;
  double rate = 1;
};

/** Most bytes of a text. */
inline constexpr size_t kMaxSpeechBytes = 1000;
/** Bounds of `rate`. */
inline constexpr double kMinSpeechRate = 0.5;
inline constexpr double kMaxSpeechRate = 2;

/** Languages of nao-speaker, as BCP 47 tags without region. Chosen: those of espeak-ng that have
 * rules for all of their usual writing (Japanese has none for kanji). */
inline constexpr auto kSpeechLanguages = std::to_array<std::string_view>(
    {"en", "ar", "cs", "da", "de", "el", "es", "fi", "fr", "hi", "hu",
     "it", "nb", "nl", "pl", "pt", "ro", "ru", "sv", "tr", "uk", "zh"});

/** Looks up a language, in upper or lower case, without the subtags that nao-speaker does not tell
 * apart: "de" for "de-AT" (RFC 4647, section 3.4).
 * @return One of kSpeechLanguages; empty if there is none. */
std::string_view find_speech_language(const std::string& tag);

/** Checks every field. The text may have any characters but control characters other than tab and
 * line end; nothing in it is markup.
 * @return Nothing, or the fault: "speech-operation-unknown", "text-missing", "text-too-long",
 *   "text-not-unicode", "text-control-character", "language-unknown", "volume-out-of-range" or
 *   "rate-out-of-range". */
[[nodiscard]] std::optional<Reason> check(const SpeechCommand& command);

SpeechCommand to_speech_command(const naolcm::speech_command_t& message);

/** The message without time, source and number. */
naolcm::speech_command_t to_message(const SpeechCommand& command);

}  // namespace nao
