#pragma once

#include <string>

namespace nao::gateway {

/** Name of the operator's console, where clients have their own names. */
inline constexpr const char* kOperatorName = "the operator";

/** A requested client name made safe to display: control characters and outer spaces removed, at
 * most 40 characters. @param requested  UTF-8. */
std::string clean_client_name(const std::string& requested);

}  // namespace nao::gateway
