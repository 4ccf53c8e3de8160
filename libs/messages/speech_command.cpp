#include "messages/speech_command.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "common/joined.h"
#include "messages/command.h"
#include "messages/utf8.h"

namespace nao {
namespace {

using Operation = SpeechCommand::Operation;

bool is_whitespace(char32_t code) {
  return code == ' ' || code == '\t' || code == '\n' || code == '\r';
}

/** The controls of ASCII and of ISO 8859 (C0, DEL and C1), but for tab and line ends. Some of them
 * begin commands of speech synthesizers. */
bool is_control(char32_t code) {
  return !is_whitespace(code) && (code < 0x20 || (code >= 0x7f && code < 0xa0));
}

/** "U+0007". */
std::string name_of(char32_t code) {
  std::array<char, 16> name{};
  std::snprintf(name.data(), name.size(), "U+%04X", static_cast<unsigned>(code));
  return name.data();
}

std::optional<Reason> check_text(const std::string& text) {
  if (text.size() > kMaxSpeechBytes) {
    return Reason("text-too-long", {std::to_string(text.size()), std::to_string(kMaxSpeechBytes)});
  }
  bool has_content = false;
  for (size_t position = 0; position < text.size();) {
    const auto character = read_utf8(text, position);
    if (!character) return Reason("text-not-unicode", {std::to_string(position + 1)});
    if (is_control(character->code)) {
      return Reason("text-control-character", {name_of(character->code)});
    }
    has_content |= !is_whitespace(character->code);
    position += character->num_bytes;
  }
  if (!has_content) return Reason("text-missing");
  return std::nullopt;
}

}  // namespace

std::string_view find_speech_language(const std::string& tag) {
  std::string range;
  for (const char c : tag) {
    range += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  while (true) {
    const auto found = std::find(kSpeechLanguages.begin(), kSpeechLanguages.end(), range);
    if (found != kSpeechLanguages.end()) return *found;
    const size_t end = range.rfind('-');
    if (end == std::string::npos) return {};
    range.resize(end);
  }
}

std::optional<Reason> check(const SpeechCommand& command) {
  const int operation = static_cast<int>(command.operation);
  if (operation < 0 || operation > static_cast<int>(Operation::kSayAfter)) {
    return Reason("speech-operation-unknown", {std::to_string(operation)});
  }
  if (command.operation == Operation::kStop) return std::nullopt;
  if (auto fault = check_text(command.text)) return fault;
  if (!command.language.empty() && find_speech_language(command.language).empty()) {
    return Reason("language-unknown", {quoted(command.language), joined(kSpeechLanguages)});
  }
  // Written so that NaN fails, too.
  if (!(command.volume >= 0 && command.volume <= 1)) {
    return Reason("volume-out-of-range", {to_argument(command.volume)});
  }
  if (!(command.rate >= kMinSpeechRate && command.rate <= kMaxSpeechRate)) {
    return Reason("rate-out-of-range", {to_argument(command.rate), to_argument(kMinSpeechRate),
                                        to_argument(kMaxSpeechRate)});
  }
  return std::nullopt;
}

SpeechCommand to_speech_command(const naolcm::speech_command_t& message) {
  static_assert(naolcm::speech_command_t::OPERATION_SAY == static_cast<int>(Operation::kSay));
  static_assert(naolcm::speech_command_t::OPERATION_SAY_AFTER ==
                static_cast<int>(Operation::kSayAfter));
  return {static_cast<Operation>(message.operation), message.text, message.language, message.volume,
          message.rate};
}

naolcm::speech_command_t to_message(const SpeechCommand& command) {
  naolcm::speech_command_t message{};
  message.operation = static_cast<int8_t>(command.operation);
  message.text = command.text;
  message.language = command.language;
  message.volume = command.volume;
  message.rate = command.rate;
  return message;
}

}  // namespace nao
