// Input of libFuzzer: the text of a speech command; the first byte is the length of its language.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "messages/speech_command.h"
#include "messages/utf8.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  nao::SpeechCommand command;
  command.language = bytes.substr(0, data[0]);
  command.text = bytes.substr(command.language.size());
  const auto fault = nao::check(command);
  if (fault && nao::to_sentence(*fault).empty()) std::abort();
  if (fault) return 0;
  // What passed has only whole characters, and is short.
  size_t position = 0;
  while (position < command.text.size()) {
    const auto character = nao::read_utf8(command.text, position);
    if (!character || character->code == 0) std::abort();
    position += character->num_bytes;
  }
  if (position != command.text.size() || position > nao::kMaxSpeechBytes) std::abort();
  return 0;
}
