#pragma once

#include <string>

namespace nao {

/** What the operator's console is called where a client's name would stand. */
inline constexpr const char* kOperatorName = "the operator";

/** A client's wish for its name, made fit to be shown to others: control characters become nothing,
 * spaces around it go, at most 40 characters are left. @param wished  UTF-8. */
std::string clean_client_name(const std::string& wished);

}  // namespace nao
