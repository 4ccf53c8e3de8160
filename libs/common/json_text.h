#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace nao {

// JSON text into values. The library's parser is a template, which takes the compiler seconds: here
// it is compiled once.

/** @throws nlohmann::json::parse_error  It is not JSON. */
nlohmann::json parse_json(std::string_view text);

/** @return Nothing if it is not JSON. */
std::optional<nlohmann::json> try_parse_json(std::string_view text);

}  // namespace nao
