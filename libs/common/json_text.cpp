#include "common/json_text.h"

namespace nao {

nlohmann::json parse_json(std::string_view text) {
  return nlohmann::json::parse(text);
}

std::optional<nlohmann::json> try_parse_json(std::string_view text) {
  nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
  if (value.is_discarded()) return std::nullopt;
  return value;
}

}  // namespace nao
