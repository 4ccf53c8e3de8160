#include "messages/reason.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <ostream>

namespace nao {

std::string to_sentence(const Reason& reason) {
  const size_t index = find_reason_entry(reason.code);
  if (index == kReasons.size()) return reason.code;
  return fill_in_arguments(kReasons[index].sentence, reason.arguments);
}

std::string fill_in_arguments(std::string_view sentence,
                              const std::vector<std::string>& arguments) {
  std::string result;
  for (size_t i = 0; i < sentence.size(); ++i) {
    // A placeholder is "{" digit "}"; a missing argument stays visible as its placeholder.
    const bool is_placeholder = sentence[i] == '{' && i + 2 < sentence.size() &&
                                std::isdigit(static_cast<unsigned char>(sentence[i + 1])) != 0 &&
                                sentence[i + 2] == '}';
    const size_t argument = is_placeholder ? static_cast<size_t>(sentence[i + 1] - '0') : 0;
    if (!is_placeholder || argument >= arguments.size()) {
      result += sentence[i];
      continue;
    }
    result += arguments[argument];
    i += 2;
  }
  return result;
}

std::ostream& operator<<(std::ostream& stream, const Reason& reason) {
  return stream << reason.code << ": " << to_sentence(reason);
}

std::string to_argument(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

}  // namespace nao
