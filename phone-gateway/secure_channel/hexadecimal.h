#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nao {

/** Two lower-case digits a byte. */
std::string to_hex(std::string_view bytes);
/** @return Nothing unless these are the lower-case digits of `num_bytes` bytes. */
[[nodiscard]] std::optional<std::string> from_hex(std::string_view digits, size_t num_bytes);

/** Bytes of the system's random source. @throws Error  It fails. */
std::string random_bytes(size_t num_bytes);

}  // namespace nao
